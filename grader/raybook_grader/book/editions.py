"""What the reader of one edition sees of the source, piece by piece.

Students have the exported files: stubs, no solutions, and line numbers of their own. Instructors
have the files of the checkout: the book shows them the solutions, and the stubs beside them.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from enum import StrEnum
from functools import cached_property

from ..literate.export import ExportedFile, export, has_visible_lines, is_visible
from ..literate.pieces import Line, Piece, Role, SourceFile
from ..literate.tree import SourceTree


class Edition(StrEnum):
    """Whose book it is."""

    INSTRUCTOR = "instructor"
    STUDENT = "student"


@dataclass(frozen=True)
class BookLine:
    """A line as the reader has it; `number` is its line in the reader's file."""

    number: int
    text: str
    origin: int


BookItem = BookLine | Piece


def key_of(piece: Piece, tree: SourceTree) -> str:
    """The name of a piece in links: "frag-bvh-build", or "file-src-accel-bvh-c" for a root."""
    slug = re.sub(r"[^a-z0-9]+", "-", piece.slug.lower()).strip("-")
    number = tree.index(piece)
    return f"{slug if piece.is_root else f'frag-{slug}'}{f'-{number + 1}' if number else ''}"


class Reader:
    """The source through the eyes of one edition's reader. `tree` must be sound."""

    def __init__(self, tree: SourceTree, edition: Edition) -> None:
        self.tree = tree.require_sound()
        self.edition = edition

    @cached_property
    def files(self) -> dict[str, SourceFile]:
        """The modules: every source file but the tests."""
        tests = re.compile(r"test_[^/]+")
        return {
            name: file
            for name, file in self.tree.files.items()
            if not tests.fullmatch(name.rpartition("/")[2])
        }

    @cached_property
    def pieces(self) -> dict[str, Piece]:
        """Every piece that this reader sees, by key: a file's root, then its fragments."""
        own = (p for f in self.files.values() for p in (f.root, *f.pieces()))
        return {self.key(p): p for p in own if self.sees(p)}

    def key(self, piece: Piece) -> str:
        return key_of(piece, self.tree)

    def sees(self, piece: Piece) -> bool:
        """Whether any line of the piece is shown to this reader as code of the book."""
        source = self.tree.files[piece.file]
        ancestors = _with_ancestors(piece)
        return all(self._passes(p) for p in ancestors) and has_visible_lines(
            source, piece, self._revealed
        )

    def items(self, piece: Piece) -> list[BookItem]:
        """What the reader sees in a piece, in order: its own lines, and fragments nested in it."""
        shown: list[BookItem] = []
        for item in self.tree.files[piece.file].items(piece):
            if isinstance(item, Piece):
                shown += [item] if self.sees(item) else []
            elif line := self._line(piece.file, item):
                shown.append(line)
        return shown

    def stub(self, piece: Piece) -> list[Line]:
        """The stub lines in a piece, which only an instructor sees beside the solution."""
        if self.edition is Edition.STUDENT:
            return []
        return [line for line in self._own_lines(piece) if line.role is Role.STUB]

    def span(self, piece: Piece) -> tuple[int, int]:
        """The first and the last line of the piece in the reader's file."""
        if self.edition is Edition.STUDENT:
            return self._exported[piece.file].span(piece) or (1, 1)
        if piece.is_root:
            return piece.first, piece.last
        return piece.first + 1, piece.last - 1

    def text(self, file: str) -> str:
        """The file that comes of putting the book's pieces together again."""
        if self.edition is Edition.STUDENT:
            return self._exported[file].text
        lines = self.tree.files[file].lines()
        return "".join(f"{line.text}\n" for line in lines if line.role is not Role.STUB)

    def line_number(self, file: str, line: int) -> int:
        """The reader's number of an original line, or of the next one that is there."""
        if self.edition is Edition.INSTRUCTOR:
            return line
        numbers = self._numbers[file]
        return next((numbers[n] for n in sorted(numbers) if n >= line), 1)

    def owner_of(self, file: str, line: int) -> Piece | None:
        """The piece among whose own lines the reader sees an original line."""
        return self._owners.get((file, line))

    # What is behind these.

    @property
    def _revealed(self) -> frozenset[str]:
        everything = self.edition is Edition.INSTRUCTOR
        return frozenset(self.tree.todos) if everything else frozenset()

    def _passes(self, piece: Piece) -> bool:
        return is_visible(piece, self._revealed)

    def _line(self, file: str, line: Line) -> BookLine | None:
        if self.edition is Edition.INSTRUCTOR:
            return None if line.role is Role.STUB else BookLine(line.number, line.text, line.number)
        number = self._numbers[file].get(line.number)
        return BookLine(number, line.text, line.number) if number else None

    def _own_lines(self, piece: Piece) -> Iterator[Line]:
        """The piece's lines, and those of fragments in it that only a stub holds."""
        for item in self.tree.files[piece.file].items(piece):
            if isinstance(item, Line):
                yield item
            elif item.role is Role.STUB:
                yield from self._own_lines(item)

    @cached_property
    def _exported(self) -> Mapping[str, ExportedFile]:
        return {name: export(file) for name, file in self.files.items()}

    @cached_property
    def _numbers(self) -> Mapping[str, Mapping[int, int]]:
        """For each file, the student's number of each original line that is left."""
        return {
            name: {line.origin: n for n, line in enumerate(file.lines, 1) if not line.is_title}
            for name, file in self._exported.items()
        }

    @cached_property
    def _owners(self) -> Mapping[tuple[str, int], Piece]:
        return {
            (piece.file, item.origin): piece
            for piece in self.pieces.values()
            for item in self.items(piece)
            if isinstance(item, BookLine)
        }


def _with_ancestors(piece: Piece) -> Iterator[Piece]:
    inner: Piece | None = piece
    while inner is not None:
        yield inner
        inner = inner.parent
