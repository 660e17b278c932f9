"""Where in the book each piece and each exercise is shown, as Sphinx gathers it from the pages."""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass, field

from sphinx.environment import BuildEnvironment


@dataclass(frozen=True, order=True)
class Place:
    """A page and the line of it."""

    page: str
    line: int

    def __str__(self) -> str:
        return f"docs/{self.page}.md:{self.line}"


@dataclass
class Places:
    """By a piece's key or an exercise's name: every place that shows it."""

    pieces: defaultdict[str, list[Place]] = field(default_factory=lambda: defaultdict(list))
    exercises: defaultdict[str, list[Place]] = field(default_factory=lambda: defaultdict(list))

    def page_of(self, key: str) -> str | None:
        """The page that shows a piece; None if none does."""
        places = self.pieces.get(key)
        return places[0].page if places else None


def places_of(environment: BuildEnvironment) -> Places:
    """The book's places; every build reads every page, so none is stale."""
    if not hasattr(environment, "raybook_places"):
        environment.raybook_places = Places()  # type: ignore[attr-defined]
    places: Places = environment.raybook_places  # type: ignore[attr-defined]
    return places
