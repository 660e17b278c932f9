"""The course as the grader sees it: its assignments, what they own and how they are checked."""

from .load import load_course
from .model import (
    Assignment,
    BuildCheck,
    Check,
    CostCheck,
    Course,
    ImageCheck,
    Limits,
    ProbeCheck,
    RobustCheck,
    StatisticsCheck,
    UnitCheck,
)

__all__ = [
    "Assignment",
    "BuildCheck",
    "Check",
    "CostCheck",
    "Course",
    "ImageCheck",
    "Limits",
    "ProbeCheck",
    "RobustCheck",
    "StatisticsCheck",
    "UnitCheck",
    "load_course",
]
