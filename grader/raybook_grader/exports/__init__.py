"""Grades for other programs: CSV, Canvas, Moodle, Gradescope and JSON."""

from .write import FORMATS, Request, Written, write_export

__all__ = ["FORMATS", "Request", "Written", "write_export"]
