"""What the class page shows, computed from the results."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from statistics import mean, median

from ..database import Module, Student
from ..grading.result import ModuleResult
from ..grading.totals import Totals, totals
from ..policy import Settled
from ..scoring import Verdict
from .findings import (
    CommonFailure,
    Fault,
    KnownMistake,
    Stuck,
    common_failures,
    faults,
    known_mistakes,
    stuck,
)
from .marks import mark_of
from .names import module_page, page_name
from .notices import UNSAFE, Notice

TONES = {
    "good": "pass",
    "fair": "partial",
    "bad": "fail",
    "stopped": "stopped",
    "none": "missing",
    "ours": "internal-error",
}
"""The verdicts by what they look like: whatever stopped a program counts as one."""

_BARS = 10


@dataclass(frozen=True)
class Row:
    """A student's row in the grid; ``cells`` has one entry a module, None if never graded.

    ``pages`` are those of the modules, relative to the class page.
    """

    student: str
    page: str
    pages: tuple[str, ...]
    problem: str | None
    totals: Totals
    cells: tuple[ModuleResult | None, ...]
    notes: tuple[str, ...] = ()
    """Why a cell's points are not those of its checks, in a word; one entry a module."""

    @property
    def has_internal_error(self) -> bool:
        return any(cell and cell.verdict is Verdict.INTERNAL_ERROR for cell in self.cells)

    @property
    def is_unsafe(self) -> bool:
        """Some code of theirs ran without the sandbox."""
        return any(cell is not None and cell.unsafe for cell in self.cells)

    @property
    def is_empty(self) -> bool:
        """Nothing was handed in of what is graded."""
        return all(cell is None or cell.verdict is Verdict.MISSING for cell in self.cells)

    @property
    def share(self) -> float | None:
        """Of the required points, in per cent."""
        if self.totals.score is None or not self.totals.max_score:
            return None
        return 100 * self.totals.score / self.totals.max_score


@dataclass(frozen=True)
class Bar:
    """The students whose share of the points lies from ``low`` to ``high`` per cent."""

    low: int
    high: int
    count: int


@dataclass(frozen=True)
class ModuleSummary:
    """How the class did in one module; ``counts`` are of `TONES`, in their order."""

    module: Module
    counts: tuple[int, ...]
    mean: float | None
    """Of those that handed something in, in points."""


@dataclass(frozen=True)
class ClassView:
    """All of the page; ``rows`` has those with an internal error first, then by id."""

    course: str
    modules: tuple[Module, ...]
    rows: tuple[Row, ...]
    bars: tuple[Bar, ...]
    mean: float | None
    median: float | None
    summaries: tuple[ModuleSummary, ...]
    mistakes: tuple[KnownMistake, ...]
    failures: tuple[CommonFailure, ...]
    stuck: tuple[Stuck, ...]
    faults: tuple[Fault, ...]
    notices: tuple[Notice, ...]

    @property
    def empty(self) -> list[Row]:
        return [row for row in self.rows if row.is_empty]


def class_view(
    course: str,
    modules: Sequence[Module],
    students: Iterable[Student],
    notices: Iterable[Notice] = (),
) -> ClassView:
    """Compute the page from results without pictures."""
    rows = sorted((_row(s, modules) for s in students), key=lambda r: not r.has_internal_error)
    shares = [row.share for row in rows if row.share is not None]
    return ClassView(
        course=course,
        modules=tuple(modules),
        rows=tuple(rows),
        bars=_bars(shares),
        mean=mean(shares) if shares else None,
        median=median(shares) if shares else None,
        summaries=tuple(_summary(m, [r.cells[i] for r in rows]) for i, m in enumerate(modules)),
        mistakes=known_mistakes(modules, rows),
        failures=common_failures(modules, rows),
        stuck=stuck(modules, rows),
        faults=faults(modules, rows),
        notices=(*notices, *([UNSAFE] if any(row.is_unsafe for row in rows) else [])),
    )


def _row(student: Student, modules: Sequence[Module]) -> Row:
    return Row(
        student=student.id,
        page=f"students/{page_name(student.id)}",
        pages=tuple(f"students/{module_page(student.id, module)}" for module in modules),
        problem=student.problem,
        totals=totals(student, modules),
        cells=tuple(student.results.get(module.number) for module in modules),
        notes=tuple(_note(student.settled.get(module.number)) for module in modules),
    )


def _note(settled: Settled | None) -> str:
    if settled is None:
        return ""
    if settled.override:
        return "set by hand"
    return f"{settled.penalty.days_late} d late" if settled.penalty else ""


def _bars(shares: Sequence[float]) -> tuple[Bar, ...]:
    width = 100 // _BARS
    counts = Counter(min(int(share // width), _BARS - 1) for share in shares)
    return tuple(Bar(i * width, (i + 1) * width, counts[i]) for i in range(_BARS))


def _summary(module: Module, cells: Sequence[ModuleResult | None]) -> ModuleSummary:
    graded = [cell for cell in cells if cell is not None]
    counts = Counter(mark_of(cell.verdict).tone for cell in graded)
    scores = [
        cell.score
        for cell in graded
        if cell.score is not None and cell.verdict is not Verdict.MISSING
    ]
    return ModuleSummary(
        module, tuple(counts[tone] for tone in TONES), mean(scores) if scores else None
    )
