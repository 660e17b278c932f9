"""All pairs of a class, and of a class with earlier years, module by module."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations, product
from pathlib import Path

import numpy as np

from ..checks.stub import stub_text
from ..course import Assignment, Course
from ..submissions import Submission
from .document import Document, Owner, base_of, document
from .pair import Pair, compare


@dataclass(frozen=True)
class Findings:
    """One module. ``alike`` are the pairs from the threshold on, the most alike first.

    ``median`` and ``next`` (the highest share below the threshold) tell how far the pairs stand
    out; None if there is no such pair. ``left_out`` are submissions with the reason.
    """

    assignment: Assignment
    compared: int
    pairs: int
    alike: tuple[Pair, ...]
    median: float | None
    next: float | None
    left_out: tuple[tuple[str, str], ...]


def search(
    course: Course,
    submissions: Sequence[Submission],
    earlier: Mapping[str, Sequence[Submission]],
    threshold: float,
    say: Callable[[str], None] = lambda words: None,
) -> list[Findings]:
    """Compare the class with itself and with ``earlier`` years, which are not compared alone."""
    base = handout_base(course.root)
    found = []
    for assignment in course.assignments:
        if assignment.sources:
            say(f"{assignment.number} {assignment.module}")
            found.append(_search(assignment, submissions, earlier, base, threshold))
    return found


def handout_base(root: Path) -> frozenset[int]:
    """The student edition's source: stubs, headers and all that is not an exercise."""
    files = sorted((root / "src").rglob("*.[ch]"))
    names = [file.relative_to(root).as_posix() for file in files]
    return base_of(stub_text(root, n) for n in names if not Path(n).name.startswith("test_"))


def _search(
    assignment: Assignment,
    submissions: Sequence[Submission],
    earlier: Mapping[str, Sequence[Submission]],
    base: frozenset[int],
    threshold: float,
) -> Findings:
    left_out: list[tuple[str, str]] = []
    ours = _documents(assignment, "", submissions, base, left_out)
    old = [
        one
        for origin, theirs in earlier.items()
        for one in _documents(assignment, origin, theirs, base, [])
    ]
    pairs = [compare(a, b) for a, b in (*combinations(ours, 2), *product(ours, old))]
    alike = [pair for pair in pairs if pair.similarity >= threshold]
    shares = [pair.similarity for pair in pairs]
    below = [share for share in shares if share < threshold]
    return Findings(
        assignment=assignment,
        compared=len(ours),
        pairs=len(pairs),
        alike=tuple(sorted(alike, key=lambda p: (-p.similarity, p.a.owner, p.b.owner))),
        median=float(np.median(shares)) if shares else None,
        next=max(below, default=None),
        left_out=tuple(left_out),
    )


def _documents(
    assignment: Assignment,
    origin: str,
    submissions: Iterable[Submission],
    base: frozenset[int],
    left_out: list[tuple[str, str]],
) -> list[Document]:
    found = []
    for submission in submissions:
        files = {path: f for path, f in submission.files.items() if path in assignment.sources}
        if not files:
            continue
        one = document(Owner(submission.id, origin), files, base)
        if isinstance(one, Document):
            found.append(one)
        else:
            left_out.append((submission.id, one))
    return found
