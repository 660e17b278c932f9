"""The nearest known mistakes of a failing module, said only when they are near."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any

from ..checks.result import NO_FAULT, CheckResult, Status
from .trace import likeness

_WEIGHTS = {"build": 0.25, "unit": 0.5, "image": 1.0, "cost": 0.5, "robust": 0.5}
_PROBE = 2.0
"""A probe has thousands of cases, and says the most."""

NEAR = 0.35
"""Below this likeness a mistake is not named at all."""
SURE = 0.2
"""Below this confidence neither."""
_SHARPNESS = 10.0
"""How much a small difference in likeness says about which of two mistakes it is."""
_NAMED = 2


@dataclass(frozen=True)
class Diagnosis:
    """A known mistake that the module looks like; ``confidence`` from 0 to 1."""

    mistake: str
    confidence: float
    hint: str
    because: str
    """What both have in common, in words."""

    def to_json(self) -> dict[str, Any]:
        return asdict(self)


@dataclass(frozen=True)
class Known:
    """A mistake of the museum with what it looked like when it was judged."""

    slug: str
    hint: str
    checks: tuple[CheckResult, ...]


def nearest(checks: Sequence[CheckResult], known: Sequence[Known]) -> tuple[Diagnosis, ...]:
    """At most two mistakes, the likeliest first; none for a module that fails no check."""
    if not any(_is_wrong(check) for check in checks):
        return ()
    alike = sorted(((similarity(checks, k.checks), k) for k in known), key=_order)
    weights = [math.exp(_SHARPNESS * (value - alike[0][0])) for value, _ in alike]
    named = []
    for (value, k), weight in list(zip(alike, weights, strict=True))[:_NAMED]:
        confidence = round(value * weight / sum(weights), 2)
        if value >= NEAR and confidence >= SURE:
            named.append(Diagnosis(k.slug, confidence, k.hint, _because(checks, k)))
    return tuple(named)


def similarity(a: Sequence[CheckResult], b: Sequence[CheckResult]) -> float:
    """From 0 to 1, over the checks that either fails."""
    ours, theirs = _wrong_by_name(a), _wrong_by_name(b)
    run = {check.name for check in a} & {check.name for check in b}
    total = weights = 0.0
    for name in sorted((ours.keys() | theirs.keys()) & run):
        weight = _WEIGHTS.get((ours.get(name) or theirs[name]).kind, _PROBE)
        weights += weight
        if name in ours and name in theirs:
            total += weight * _alike(ours[name], theirs[name])
    return total / weights if weights else 0.0


def _alike(a: CheckResult, b: CheckResult) -> float:
    if a.status is not b.status:
        return 0.0
    value = likeness(a.trace, b.trace)
    if value is None:
        return 1.0 if a.fingerprint == b.fingerprint else 0.25
    return value


def _wrong_by_name(checks: Sequence[CheckResult]) -> Mapping[str, CheckResult]:
    return {check.name: check for check in checks if check.status not in NO_FAULT}


def _is_wrong(check: CheckResult) -> bool:
    """Lost points for slowness, noise or a warning are no mistake."""
    return check.status not in (*NO_FAULT, Status.PARTIAL)


def _order(entry: tuple[float, Known]) -> tuple[float, str]:
    return -entry[0], entry[1].slug


def _because(checks: Sequence[CheckResult], known: Known) -> str:
    ours, theirs = _wrong_by_name(checks), _wrong_by_name(known.checks)
    shared = [name for name in ours if name in theirs]
    best = sorted(shared, key=lambda name: -_alike(ours[name], theirs[name]))[:2]
    return "it fails in the same way in: " + "; ".join(best)
