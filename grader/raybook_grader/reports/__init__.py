"""The pages that students and instructors read. Each is one file that opens offline."""

from .pages import INDEX, write_reports

__all__ = ["INDEX", "write_reports"]
