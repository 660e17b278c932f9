"""The results of a class in one SQLite file, safe against a kill at any moment."""

from .database import Database, Module, Student

__all__ = ["Database", "Module", "Student"]
