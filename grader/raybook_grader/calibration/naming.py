"""How often the diagnosis names the right mistake, on modules that it has not learned from.

A mistake and its twins are the same mistake, written by different hands. Each in turn is left
out of what the diagnosis knows, and is named by what remains: a twin by the museum, and a
mistake of the museum by a museum that has its twin in its place.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from ..diagnosis import Known, nearest
from ..grading.result import ModuleResult
from ..museum import Exhibit, Twin


@dataclass(frozen=True)
class Naming:
    """One trial: whose mistake it was, and what the diagnosis said, the likeliest first."""

    assignment: str
    module: str
    mistake: str
    said: tuple[str, ...]

    @property
    def first(self) -> bool:
        return self.said[:1] == (self.mistake,)

    @property
    def among_two(self) -> bool:
        return self.mistake in self.said[:2]


def namings(
    mistakes: Sequence[Exhibit],
    twins: Sequence[Twin],
    results: Mapping[str, ModuleResult],
) -> Iterator[Naming]:
    """All trials of one assignment; ``results`` are by the exhibit's name."""
    library = library_of(mistakes, results)
    for twin in twins:
        exhibit = twin.exhibit
        yield _trial(exhibit, twin.mistake, library, results)
        own = next(e for e in mistakes if e.slug == twin.mistake)
        others = [known for known in library if known.slug != twin.mistake]
        yield _trial(own, twin.mistake, [*others, _known(exhibit, twin.mistake, results)], results)


def library_of(mistakes: Iterable[Exhibit], results: Mapping[str, ModuleResult]) -> list[Known]:
    """What the diagnosis knows of an assignment."""
    return [_known(exhibit, exhibit.slug, results) for exhibit in mistakes]


def spoken(
    right: Iterable[Exhibit], results: Mapping[str, ModuleResult], known: Sequence[Known]
) -> tuple[str, ...]:
    """The right modules that the diagnosis does not keep silent on: none, one hopes."""
    return tuple(e.name for e in right if nearest(results[e.name].checks, known))


def _trial(
    exhibit: Exhibit, mistake: str, known: Sequence[Known], results: Mapping[str, ModuleResult]
) -> Naming:
    said = nearest(results[exhibit.name].checks, known)
    return Naming(exhibit.assignment, exhibit.slug, mistake, tuple(d.mistake for d in said))


def _known(exhibit: Exhibit, slug: str, results: Mapping[str, ModuleResult]) -> Known:
    return Known(slug, exhibit.label.hint if exhibit.label else "", results[exhibit.name].checks)
