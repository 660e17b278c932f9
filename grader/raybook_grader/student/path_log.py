"""Reading what `raybook --pixel` prints, and finding the first step at which two logs differ."""

from __future__ import annotations

import re
from dataclasses import dataclass
from itertools import zip_longest
from pathlib import Path

_SAMPLES, _SEED = 2, 1
_NUMBER = re.compile(r"(?<![\w.])[-+]?(?:\d+\.?\d*(?:e[-+]?\d+)?|inf|nan)", re.IGNORECASE)
# The log shows six digits; right modules round differently, and glass makes it more.
_RELATIVE, _ABSOLUTE = 2e-3, 1e-4

_KINDS = (
    ("sample", "the ray that the camera sends"),
    ("hit object", "which object the ray meets, and where"),
    ("normal", "the surface at that point"),
    ("leaves the scene", "whether the ray meets anything"),
    ("asks light", "the direction to the light"),
    ("radiance", "what the light sends, and what the surface does with it"),
    ("gives", "what comes of that light here: angle and shadow"),
    ("goes on along", "the direction in which the path goes on, and its weight"),
    ("finds light", "the light that the path finds by itself"),
    ("=", "the light of the whole path"),
)


def log_options(pixel: tuple[int, int], output: Path) -> list[str]:
    """The renderer's options for a log: always the same samples."""
    settings = ["--quiet", "--seed", str(_SEED), "--spp", str(_SAMPLES), "--threads", "1"]
    return [*settings, "--pixel", f"{pixel[0]},{pixel[1]}", "-o", str(output)]


@dataclass(frozen=True)
class FirstDifference:
    """The step (a line, from 0) at which two logs part; "" for one that has ended there.

    ``sample`` is the path's number and ``about`` what kind of step it is, in words.
    """

    step: int
    sample: int
    about: str
    yours: str
    expected: str


def first_difference(yours: str, expected: str) -> FirstDifference | None:
    """Where two logs of one pixel first say something else, rounding aside; None if nowhere."""
    sample = -1
    pairs = zip_longest(yours.splitlines(), expected.splitlines(), fillvalue="")
    for step, (mine, theirs) in enumerate(pairs):
        sample += theirs.startswith("sample") or (not theirs and mine.startswith("sample"))
        if not _same(mine, theirs):
            return FirstDifference(step, sample, _about(theirs or mine), mine, theirs)
    return None


def _same(mine: str, theirs: str) -> bool:
    if _NUMBER.sub("#", mine) != _NUMBER.sub("#", theirs):
        return False
    pairs = zip(_NUMBER.findall(mine), _NUMBER.findall(theirs), strict=True)
    return all(_close(float(a), float(b)) for a, b in pairs)


def _close(a: float, b: float) -> bool:
    if a == b or (a != a and b != b):
        return True
    return abs(a - b) <= _ABSOLUTE + _RELATIVE * max(abs(a), abs(b))


def _about(line: str) -> str:
    words = line.strip()
    return next((about for start, about in _KINDS if words.startswith(start)), "this step")
