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
from .pictures import PublicPicture

__all__ = [
    "Assignment",
    "BuildCheck",
    "Check",
    "CostCheck",
    "Course",
    "ImageCheck",
    "Limits",
    "ProbeCheck",
<<<<<<< HEAD
    "RobustCheck",
    "StatisticsCheck",
=======
    "PublicPicture",
>>>>>>> b6130c2 (The student's loop: make check, watch, hint and debug, here and in the handout)
    "UnitCheck",
    "load_course",
]
