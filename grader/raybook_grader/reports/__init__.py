"""The pages that students and instructors read. Each is one file that opens offline."""

from .notices import Notice
from .pages import INDEX, STUDENTS, write_reports

__all__ = ["INDEX", "STUDENTS", "Notice", "write_reports"]
