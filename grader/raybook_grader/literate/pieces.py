"""What a marked source file is made of.

A file is a root `Piece`; a piece holds lines and nested pieces. Pieces are immutable and are
compared by identity. A piece knows its parent; what it holds is asked of its `SourceFile`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from enum import StrEnum


class Role(StrEnum):
    """Who sees a line: everybody, the instructor only, or the student only."""

    CODE = "code"
    SOLUTION = "solution"
    STUB = "stub"


@dataclass(frozen=True)
class Violation:
    """One broken rule, at a place that an editor can jump to."""

    file: str
    line: int
    message: str

    def __str__(self) -> str:
        return f"{self.file}:{self.line}: {self.message}"


@dataclass(frozen=True)
class Line:
    """A line of C, without its line end; markers and the directives of a TODO are no lines.

    `todo` is the exercise whose solution or stub the line belongs to; None for plain code.
    """

    number: int
    text: str
    role: Role = Role.CODE
    todo: str | None = None


@dataclass(frozen=True, eq=False)
class Piece:
    """One run of lines of one file between `//>` and `//<`, or a whole file (its root).

    `first` and `last` are the 1-based lines of the two markers (of the file, for a root).
    `title` is empty for a continuation (`//>+`): its fragment has the title. `role` and `todo`
    are those of the place where it was opened. `parent` is None for a root only.
    """

    slug: str
    title: str
    file: str
    first: int
    last: int
    continuation: bool
    role: Role
    todo: str | None
    parent: Piece | None

    @property
    def is_root(self) -> bool:
        return self.parent is None

    @property
    def is_top_level(self) -> bool:
        """Opened in the file itself, not in another fragment."""
        return self.parent is not None and self.parent.is_root


Item = Line | Piece


@dataclass(frozen=True, eq=False)
class Region:
    """One `#ifndef TODO_name` with the lines of its directives; `piece` holds all of them.

    `middle`, the line of the `#else`, is None for the helpers of a solution: they have no stub.
    """

    name: str
    file: str
    ifndef: int
    middle: int | None
    endif: int
    piece: Piece


@dataclass(frozen=True, eq=False)
class SourceFile:
    """A parsed file. `name` is relative to the checkout ("src/shapes/triangle.c").

    With violations, the pieces are only a best guess and no product may be made of them.
    """

    name: str
    text: tuple[str, ...]
    root: Piece
    regions: tuple[Region, ...]
    violations: tuple[Violation, ...]
    contents: Mapping[Piece, tuple[Item, ...]]

    def items(self, piece: Piece) -> tuple[Item, ...]:
        """The lines and nested pieces of a piece of this file, in order."""
        return self.contents[piece]

    def pieces(self) -> Iterator[Piece]:
        """Every piece but the root, in the order in which they open."""
        return (piece for piece in self.contents if not piece.is_root)

    def lines(self) -> Iterator[Line]:
        """Every line of C of the file, in order."""
        return self._lines_of(self.root)

    def _lines_of(self, piece: Piece) -> Iterator[Line]:
        for item in self.items(piece):
            if isinstance(item, Line):
                yield item
            else:
                yield from self._lines_of(item)
