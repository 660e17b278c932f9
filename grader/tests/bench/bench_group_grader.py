"""How many modules the grader judges in a minute: group `grader`."""

from __future__ import annotations

import resource
import sys
import time
from collections.abc import Iterator

from bench_effort import Effort
from bench_machine import processors
from bench_programs import HERE, ROOT
from bench_rows import Row, spread

from raybook_grader.checks.reference import References
from raybook_grader.grading.job import Worker
from raybook_grader.grading.module import ModuleGrader
from raybook_grader.submissions import SubmittedFile

sys.path.insert(0, str(HERE.parent / "scale"))
from durations import sample

NO_KIT = "there is no build/kit: `make kit`"


def grader_rows(effort: Effort) -> Iterator[Row]:
    """A right module of each assignment, then a wrong one of each, judged one after another with
    all checks, in the sandbox."""
    row = Row("grader", "modules", "made-up class", "all assignments", unit="modules/min")
    if not (ROOT / "build" / "kit" / "kit.json").is_file():
        yield row.missing(NO_KIT)
        return
    workshop = Worker(ROOT, ROOT / "build" / "kit").workshop()
    grader = ModuleGrader(workshop, References(workshop))
    chosen = sample(ROOT, 1)[: effort.modules]
    seconds = []
    for exhibit in chosen:
        files = {path: SubmittedFile(content) for path, content in exhibit.files.items()}
        assignment = workshop.course.assignment(exhibit.assignment)
        begun = _cpu(), time.monotonic()
        grader.grade(assignment, files)
        seconds.append((_cpu() - begun[0], time.monotonic() - begun[1]))
    cpu = sum(one for one, _ in seconds)
    longest = spread([one for one, _ in seconds])
    yield Row(
        row.group, row.name, row.scene, f"{len(chosen)} modules, one core",
        figure=60 * len(chosen) / cpu, unit=row.unit,
        note=f"{longest.median:.1f} s of processor time a module ({longest.low:.1f} to "
        f"{longest.high:.1f}); {len(processors())} cores judge as many times as many",
    )  # fmt: skip


def _cpu() -> float:
    used = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return sum(one.ru_utime + one.ru_stime for one in used)
