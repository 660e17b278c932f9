"""Running students' code where it can do no harm: `Box`, its `Limits` and its `BoxResult`."""

from __future__ import annotations

from .box import Box
from .doctor import Finding, probe, require
from .errors import BoxError, SandboxUnavailable
from .limits import Limits
from .result import BoxResult
from .unfenced import make_box

__all__ = [
    "Box",
    "BoxError",
    "BoxResult",
    "Finding",
    "Limits",
    "SandboxUnavailable",
    "make_box",
    "probe",
    "require",
]
