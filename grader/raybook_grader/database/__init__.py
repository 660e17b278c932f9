"""The results of a class in one SQLite file, safe against a kill at any moment."""

from .database import NAME, Database, Module, Student, Version
from .decisions import Decision

__all__ = ["NAME", "Database", "Decision", "Module", "Student", "Version"]
