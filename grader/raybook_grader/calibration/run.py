"""A calibration from beginning to end; all that takes long is kept, and not done again."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from rich.console import Console

from ..checks.program import Workshop
from ..checks.reference import References
from ..checks.shipping import pictures_of
from ..course import Assignment, load_course
from ..grading.result import ModuleResult
from ..jobs.progress import progress
from ..kit import load_kit
from ..museum import Exhibit, Twin, exhibits_of, twins_of
from ..sandbox import Box
from .confusion import row_of
from .false_fails import Count, count_false_fails, trials_of
from .judging import Bench, Compiler, Task, judge_all
from .naming import library_of, namings, spoken
from .table import ModuleTable


@dataclass(frozen=True)
class Order:
    """What `raybook-grader calibrate` was asked for; ``looks`` verdicts on each picture."""

    root: Path
    kit: Path
    compiler: Compiler
    looks: int
    jobs: int


def calibrate(
    order: Order, assignments: Sequence[Assignment], console: Console
) -> list[ModuleTable]:
    """The tables of the given assignments."""
    _render_references(order, assignments, console)
    exhibits = {a.number: exhibits_of(order.root, a) for a in assignments}
    twins = {a.number: twins_of(order.root, a) for a in assignments}
    tasks = [
        Task(exhibit, look)
        for some in exhibits.values()
        for exhibit in some
        for look in range(order.looks)
    ]
    tasks += [Task(twin.exhibit) for some in twins.values() for twin in some]
    bench = Bench(order.root, order.kit, order.compiler)
    results = judge_all(bench, tasks, order.jobs, console)
    trials = trials_of(assignments, exhibits)
    counts = count_false_fails(order.root, order.kit, trials, order.jobs, console)
    return [
        _table(
            a,
            exhibits[a.number],
            twins[a.number],
            order.looks,
            results,
            {t.check.name: counts[t.name] for t in trials if t.assignment == a.number},
        )
        for a in assignments
    ]


def _table(
    assignment: Assignment,
    exhibits: Sequence[Exhibit],
    twins: Sequence[Twin],
    looks: int,
    results: Mapping[str, ModuleResult],
    chance: Mapping[str, Count],
) -> ModuleTable:
    first = {e.name: results[Task(e).name] for e in [*exhibits, *(t.exhibit for t in twins)]}
    mistakes = [e for e in exhibits if not e.is_right]
    right = [e for e in exhibits if e.is_right]
    rows = [
        row_of(assignment, e, [results[Task(e, look).name] for look in range(looks)])
        for e in exhibits
    ]
    return ModuleTable(
        assignment.number,
        assignment.module,
        tuple(rows),
        chance,
        tuple(namings(mistakes, twins, first)),
        spoken(right, first, library_of(mistakes, first)),
    )


def _render_references(order: Order, assignments: Sequence[Assignment], console: Console) -> None:
    """Render what is not there yet, on all cores, before the workers need it."""
    workshop = Workshop(load_course(order.root), load_kit(order.kit), Box())
    references = References(workshop)
    for picture in pictures_of(assignments):
        if not references.is_ready(picture):
            progress(console, "", 0).say(f"rendering the reference of {picture.scene}, once")
            references.statistics(picture)
