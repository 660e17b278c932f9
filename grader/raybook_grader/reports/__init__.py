"""The pages that students and instructors read. Each is one file that opens offline."""

from .pages import write_reports

__all__ = ["write_reports"]
