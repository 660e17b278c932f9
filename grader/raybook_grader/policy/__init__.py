"""What a class's `course.toml` says: deadlines, late days, extensions, and which hand-in counts."""

from .load import NAME, find_policy, parse_policy
from .model import Counts, Extension, Late, Policy
from .settle import Attempt, Override, Penalty, Settled, late_days_used, settle
from .tell import settled_json, told

__all__ = [
    "NAME",
    "Attempt",
    "Counts",
    "Extension",
    "Late",
    "Override",
    "Penalty",
    "Policy",
    "Settled",
    "find_policy",
    "late_days_used",
    "parse_policy",
    "settle",
    "settled_json",
    "told",
]
