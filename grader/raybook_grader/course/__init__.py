"""The course as the grader sees it: its assignments, what they own and how they are checked."""

from .artefacts import ArtefactCheck
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
    "ArtefactCheck",
    "Assignment",
    "BuildCheck",
    "Check",
    "CostCheck",
    "Course",
    "ImageCheck",
    "Limits",
    "ProbeCheck",
    "PublicPicture",
    "RobustCheck",
    "StatisticsCheck",
    "UnitCheck",
    "load_course",
]
