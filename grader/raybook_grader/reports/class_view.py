"""What the class page shows, computed from the results."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from statistics import mean, median

from ..checks.result import NO_FAULT
from ..database import Module, Student
from ..grading.result import ModuleResult
from ..grading.totals import Totals, totals
from ..policy import Settled
from ..scoring import Verdict
from .names import page_name

_BARS = 10
_COMMONEST = 15


@dataclass(frozen=True)
class Row:
    """A student's row in the grid; ``cells`` has one entry a module, None if never graded."""

    student: str
    page: str
    problem: str | None
    totals: Totals
    cells: tuple[ModuleResult | None, ...]
    notes: tuple[str, ...] = ()
    """Why a cell's points are not those of its checks, in a word; one entry a module."""

    @property
    def has_internal_error(self) -> bool:
        return any(cell and cell.verdict is Verdict.INTERNAL_ERROR for cell in self.cells)


@dataclass(frozen=True)
class Bar:
    """The students whose share of the points lies from ``low`` to ``high`` per cent."""

    low: int
    high: int
    count: int


@dataclass(frozen=True)
class CommonFailure:
    """One kind of failure with those who have it; ``checks`` are where it was met."""

    module: Module
    checks: tuple[str, ...]
    words: str
    students: tuple[Row, ...]


@dataclass(frozen=True)
class Fault:
    """A failure of the harness, to be mended by whoever runs it, and where it was met."""

    told: str
    places: tuple[tuple[Row, Module], ...]


@dataclass(frozen=True)
class ClassView:
    """All of the page; ``rows`` has those with an internal error first, then by id."""

    course: str
    modules: tuple[Module, ...]
    rows: tuple[Row, ...]
    bars: tuple[Bar, ...]
    mean: float | None
    median: float | None
    failures: tuple[CommonFailure, ...]
    faults: tuple[Fault, ...]
    verdicts: dict[str, Counter[str]]


def class_view(course: str, modules: Sequence[Module], students: Iterable[Student]) -> ClassView:
    """Compute the page from results without pictures."""
    rows = sorted((_row(s, modules) for s in students), key=lambda r: not r.has_internal_error)
    shares = [
        100 * row.totals.score / row.totals.max_score
        for row in rows
        if row.totals.score is not None and row.totals.max_score
    ]
    return ClassView(
        course=course,
        modules=tuple(modules),
        rows=tuple(rows),
        bars=_bars(shares),
        mean=mean(shares) if shares else None,
        median=median(shares) if shares else None,
        failures=_failures(modules, rows),
        faults=_faults(modules, rows),
        verdicts={
            module.number: Counter(
                cell.verdict.value for row in rows if (cell := row.cells[i]) is not None
            )
            for i, module in enumerate(modules)
        },
    )


def _row(student: Student, modules: Sequence[Module]) -> Row:
    return Row(
        student=student.id,
        page=f"students/{page_name(student.id)}",
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


def _failures(modules: Sequence[Module], rows: Sequence[Row]) -> tuple[CommonFailure, ...]:
    """The kinds of failure that most students have, each counted once a student and module."""
    found: dict[tuple[Module, str], dict[str, Row]] = defaultdict(dict)
    checks: dict[tuple[Module, str], dict[str, None]] = defaultdict(dict)
    for row, module, result in _results(modules, rows):
        for check in result.checks:
            if check.status not in NO_FAULT:
                kind = module, check.fingerprint or check.status.value
                found[kind][row.student] = row
                checks[kind][check.name] = None
    common = sorted(found, key=lambda kind: (-len(found[kind]), kind[0].number, kind[1]))
    return tuple(
        CommonFailure(kind[0], tuple(checks[kind]), kind[1], tuple(found[kind].values()))
        for kind in common[:_COMMONEST]
    )


def _faults(modules: Sequence[Module], rows: Sequence[Row]) -> tuple[Fault, ...]:
    """The faults of the harness, those that most modules met first."""
    found: dict[str, list[tuple[Row, Module]]] = defaultdict(list)
    for row, module, result in _results(modules, rows):
        if result.verdict is Verdict.INTERNAL_ERROR:
            found[result.traceback or result.message].append((row, module))
    faults = [Fault(told, tuple(places)) for told, places in found.items()]
    return tuple(sorted(faults, key=lambda fault: -len(fault.places)))


def _results(
    modules: Sequence[Module], rows: Sequence[Row]
) -> Iterator[tuple[Row, Module, ModuleResult]]:
    for row in rows:
        for module, result in zip(modules, row.cells, strict=True):
            if result is not None:
                yield row, module, result
