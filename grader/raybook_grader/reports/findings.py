"""What an instructor looks for in the results of a class: mistakes, who is stuck, faults."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from ..checks.result import NO_FAULT, Status
from ..database import Module
from ..grading.result import ModuleResult
from ..scoring import Verdict
from .words import headline

if TYPE_CHECKING:
    from .class_view import Row

_COMMONEST = 15
_STUCK_BELOW = 0.5


@dataclass(frozen=True)
class Place:
    """A module of a student; ``page`` is relative to the class page."""

    student: str
    module: Module
    page: str


@dataclass(frozen=True)
class KnownMistake:
    """A mistake of the museum, and the modules that look like it more than like any other."""

    module: Module
    slug: str
    hint: str
    places: tuple[Place, ...]


@dataclass(frozen=True)
class CommonFailure:
    """One kind of failure with those who have it; ``checks`` are where it was met."""

    module: Module
    checks: tuple[str, ...]
    words: str
    places: tuple[Place, ...]


@dataclass(frozen=True)
class Stuck:
    """A student who tried, and earned less than half of the points in these modules."""

    student: str
    page: str
    troubles: tuple[tuple[Place, Verdict, str], ...]


@dataclass(frozen=True)
class Fault:
    """A failure of the harness, to be mended by whoever runs it, and where it was met."""

    told: str
    places: tuple[Place, ...]

    @property
    def last_line(self) -> str:
        return self.told.strip().rpartition("\n")[2]


def known_mistakes(modules: Sequence[Module], rows: Sequence[Row]) -> tuple[KnownMistake, ...]:
    """The mistakes that most modules look like, by each one's likeliest diagnosis."""
    found: dict[tuple[str, str], list[Place]] = defaultdict(list)
    hints: dict[tuple[str, str], str] = {}
    for place, result in _results(modules, rows):
        if result.diagnosis:
            key = place.module.number, result.diagnosis[0].mistake
            found[key].append(place)
            hints[key] = result.diagnosis[0].hint
    common = sorted(found, key=lambda key: (-len(found[key]), key))[:_COMMONEST]
    return tuple(
        KnownMistake(found[key][0].module, key[1], hints[key], tuple(found[key])) for key in common
    )


def common_failures(modules: Sequence[Module], rows: Sequence[Row]) -> tuple[CommonFailure, ...]:
    """The kinds of failure that most students have, each counted once a student and module."""
    found: dict[tuple[Module, str], dict[str, Place]] = defaultdict(dict)
    checks: dict[tuple[Module, str], dict[str, None]] = defaultdict(dict)
    for place, result in _results(modules, rows):
        for check in result.checks:
            if check.status not in NO_FAULT:
                kind = place.module, check.fingerprint or check.status.value
                found[kind][place.student] = place
                checks[kind][check.name] = None
    common = sorted(found, key=lambda kind: (-len(found[kind]), kind[0].number, kind[1]))
    return tuple(
        CommonFailure(kind[0], tuple(checks[kind]), kind[1], tuple(found[kind].values()))
        for kind in common[:_COMMONEST]
    )


def stuck(modules: Sequence[Module], rows: Sequence[Row]) -> tuple[Stuck, ...]:
    """Those with most modules handed in that earned less than half of their points first."""
    found: dict[tuple[str, str], list[tuple[Place, Verdict, str]]] = defaultdict(list)
    pages = {row.student: row.page for row in rows}
    for place, result in _results(modules, rows):
        tried = result.verdict is not Verdict.MISSING and result.score is not None
        if tried and (result.score or 0) < _STUCK_BELOW * place.module.points:
            key = place.student, pages[place.student]
            found[key].append((place, result.verdict, _reason(result)))
    ordered = sorted(found, key=lambda key: (-len(found[key]), key))
    return tuple(Stuck(*key, tuple(found[key])) for key in ordered)


def faults(modules: Sequence[Module], rows: Sequence[Row]) -> tuple[Fault, ...]:
    """The faults of the harness, those that most modules met first."""
    found: dict[str, list[Place]] = defaultdict(list)
    for place, result in _results(modules, rows):
        if result.verdict is Verdict.INTERNAL_ERROR:
            found[result.traceback or result.message or _told(result)].append(place)
    told = (Fault(words, tuple(places)) for words, places in found.items())
    return tuple(sorted(told, key=lambda fault: -len(fault.places)))


def _told(result: ModuleResult) -> str:
    failed = (c.message for c in result.checks if c.status is Status.INTERNAL_ERROR)
    return next(failed, "the grader failed, and left no words")


def _reason(result: ModuleResult) -> str:
    if result.diagnosis:
        return f"looks like {result.diagnosis[0].mistake.replace('-', ' ')}"
    return headline(result)


def _results(
    modules: Sequence[Module], rows: Iterable[Row]
) -> Iterator[tuple[Place, ModuleResult]]:
    for row in rows:
        for module, page, result in zip(modules, row.pages, row.cells, strict=True):
            if result is not None:
                yield Place(row.student, module, page), result
