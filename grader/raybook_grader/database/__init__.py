"""The results of a class in one SQLite file, safe against a kill at any moment."""

from .database import NAME, Database
from .decisions import Decision
from .values import Module, Student, Version

__all__ = ["NAME", "Database", "Decision", "Module", "Student", "Version"]
