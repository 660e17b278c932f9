"""The pages that students and instructors read. Each is one file that opens offline."""

from .notices import Notice
from .pages import INDEX, write_reports

__all__ = ["INDEX", "Notice", "write_reports"]
