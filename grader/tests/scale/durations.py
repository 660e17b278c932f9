"""How long grading a module takes: real modules of every assignment, judged one after another.

What counts is processor time, our own and our children's: a job runs in one thread at a time, and
so its processor time is its wall-clock time on a machine that does nothing else.
"""

from __future__ import annotations

import json
import pickle
import resource
import time
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

from raybook_grader.checks.reference import References
from raybook_grader.course import Assignment, load_course
from raybook_grader.files import write_text
from raybook_grader.grading.job import Worker
from raybook_grader.grading.module import ModuleGrader
from raybook_grader.museum import Exhibit, exhibits_of
from raybook_grader.submissions import SubmittedFile


@dataclass(frozen=True)
class Duration:
    """A job that was timed; ``bytes`` is the size of its pickled result."""

    assignment: str
    name: str
    kind: str
    cpu_seconds: float
    wall_seconds: float
    bytes: int


def measured(file: Path, root: Path, each: int) -> list[Duration]:
    """The durations kept in ``file``; those that are missing are measured, which takes long."""
    kept = load(file)
    done = {duration.name for duration in kept}
    samples = [s for s in sample(root, each) if s.name not in done]
    if samples:
        # Without the diagnosis, which is quick, but must have judged all mistakes before.
        workshop = Worker(root, root / "build" / "kit").workshop()
        grader = ModuleGrader(workshop, References(workshop))
    for exhibit in samples:
        files = {path: SubmittedFile(content) for path, content in exhibit.files.items()}
        assignment = workshop.course.assignment(exhibit.assignment)
        before, begun = _cpu(), time.monotonic()
        result = grader.grade(assignment, files)
        wall, cpu = time.monotonic() - begun, _cpu() - before
        kind = "right" if exhibit.is_right else "wrong"
        size = len(pickle.dumps(result))
        kept.append(Duration(exhibit.assignment, exhibit.name, kind, cpu, wall, size))
        print(f"{exhibit.name}: {cpu:.1f} s of processor time, {wall:.1f} s", flush=True)
        write_text(file, json.dumps([asdict(d) for d in kept], indent=1) + "\n")
    return kept


def load(file: Path) -> list[Duration]:
    """What was measured before."""
    return [Duration(**d) for d in json.loads(file.read_text())] if file.is_file() else []


def sample(root: Path, each: int) -> list[Exhibit]:
    """From every assignment the reference and, evenly spread, some alternatives and mistakes;
    one of each assignment before the second of any."""
    columns = [list(_sample(root, a, each)) for a in load_course(root).assignments if a.sources]
    depth = max(map(len, columns))
    return [column[row] for row in range(depth) for column in columns if row < len(column)]


def _sample(root: Path, assignment: Assignment, each: int) -> Iterator[Exhibit]:
    exhibits = exhibits_of(root, assignment)
    right = _spread([e for e in exhibits if e.is_right], each)
    wrong = _spread([e for e in exhibits if not e.is_right], each)
    for pair in zip(right, wrong, strict=False):
        yield from pair


def _spread(exhibits: Sequence[Exhibit], count: int) -> list[Exhibit]:
    count = min(count, len(exhibits))
    return [exhibits[i * len(exhibits) // count] for i in range(count)]


def _cpu() -> float:
    own, children = (
        resource.getrusage(w) for w in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)
    )
    return own.ru_utime + own.ru_stime + children.ru_utime + children.ru_stime
