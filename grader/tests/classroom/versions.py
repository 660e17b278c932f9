"""The versions of each module that a made-up class hands in, and what each must score.

Most are exhibits of the museum as they stand; some are the same exhibit in other words
(`rewording`), which must score the same, but are graded anew. No two in a pool have the same bytes.
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain, zip_longest
from pathlib import Path

from rewording import reword

from raybook_grader.checks.stub import stub_text
from raybook_grader.course import Assignment
from raybook_grader.museum import Exhibit, exhibits_of, twins_of

_AS_THEY_STAND = 0.6
"""Of the versions that run, so many are exhibits as they stand, the rest are reworded ones."""

_RIGHT = 0.7
"""Of the reworded ones, so many are right: most students get there in the end."""


@dataclass(frozen=True)
class Version:
    """One way to hand a module in. Its score is the exhibit's, or is known without judging."""

    name: str
    files: Mapping[str, bytes]
    exhibit: Exhibit | None = None
    score: float | None = None


def versions_of(
    root: Path, assignment: Assignment, count: int, rng: random.Random
) -> list[Version]:
    """``count`` different versions of a module; first the reference and the stub."""
    reference, *others = _known(root, assignment, rng)
    pool = [_as_it_stands(reference), _stub(root, assignment), _broken(reference)][:count]
    chosen = others[: round(_AS_THEY_STAND * (count - len(pool)))]
    pool += map(_as_it_stands, chosen)
    right = [reference, *(exhibit for exhibit in chosen if exhibit.is_right)]
    for number in range(count - len(pool)):
        exhibit = rng.choice(right if rng.random() < _RIGHT else chosen or right)
        files = {path: reword(text, number, rng) for path, text in exhibit.files.items()}
        pool.append(Version(f"{exhibit.name}, reworded {number}", files, exhibit))
    return pool


def _known(root: Path, assignment: Assignment, rng: random.Random) -> list[Exhibit]:
    """The reference, then wrong and right modules in turn, shuffled; equal ones once."""
    reference, *others = exhibits_of(root, assignment)
    right = [exhibit for exhibit in others if exhibit.is_right]
    wrong = [exhibit for exhibit in others if not exhibit.is_right]
    wrong += [twin.exhibit for twin in twins_of(root, assignment)]
    rng.shuffle(right)
    rng.shuffle(wrong)
    order = [reference, *_in_turn(wrong, right)]
    return list({tuple(sorted(e.files.items())): e for e in reversed(order)}.values())[::-1]


def _in_turn(first: Sequence[Exhibit], second: Sequence[Exhibit]) -> Iterator[Exhibit]:
    pairs = zip_longest(first, second)
    return (exhibit for exhibit in chain.from_iterable(pairs) if exhibit is not None)


def _as_it_stands(exhibit: Exhibit) -> Version:
    return Version(exhibit.name, exhibit.files, exhibit)


def _stub(root: Path, assignment: Assignment) -> Version:
    files = {path: stub_text(root, path).encode() for path in assignment.owned}
    return Version(f"{assignment.number}/stub", files, score=0.0)


def _broken(reference: Exhibit) -> Version:
    """The reference with half a line more, as an editor leaves it at midnight."""
    path = min(reference.files)
    files = {**reference.files, path: reference.files[path] + b"\nstatic int half_a_line(\n"}
    return Version(f"{reference.assignment}/does not compile", files, score=0.0)
