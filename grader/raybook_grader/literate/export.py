"""The student's text of a source file.

Solutions are out and stubs in, so that no conditional of a TODO is left. The marker of a nested
fragment becomes a comment with its title; the other markers vanish. No two blank lines follow
each other, and none is first or last; every other line is kept to the byte.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import dataclass

from .pieces import Line, Piece, Role, SourceFile
from .tree import UnsoundSourceError


@dataclass(frozen=True)
class ExportedLine:
    """A line of the student's file and the line of the original that it comes from.

    `is_title` is true of the comment that stands for a fragment's marker.
    """

    text: str
    origin: int
    is_title: bool = False


@dataclass(frozen=True)
class ExportedFile:
    """The student's edition of one file; line n of it is `lines[n - 1]`."""

    name: str
    lines: tuple[ExportedLine, ...]

    @property
    def text(self) -> str:
        return "".join(f"{line.text}\n" for line in self.lines)

    def origin(self, line: int) -> int:
        """The line of the original that line `line` (from 1) comes from."""
        return self.lines[line - 1].origin

    def span(self, piece: Piece) -> tuple[int, int] | None:
        """The first and last line here of a piece of the original; None if none is left."""
        inside = [n for n, line in enumerate(self.lines, 1) if _within(line, piece)]
        return (inside[0], inside[-1]) if inside else None


def export(source: SourceFile, reveal: Collection[str] = ()) -> ExportedFile:
    """The student's edition of a file, with the solutions of the exercises in `reveal`.

    Raises UnsoundSourceError if the file has violations.
    """
    if source.violations:
        raise UnsoundSourceError(source.violations)
    lines: list[ExportedLine] = []
    for line in _kept(source, source.root, reveal):
        if line.text.strip() or (lines and lines[-1].text.strip()):
            lines.append(line)
    while lines and not lines[-1].text.strip():
        lines.pop()
    return ExportedFile(source.name, tuple(lines))


def is_visible(item: Line | Piece, reveal: Collection[str] = ()) -> bool:
    """Whether a student who may see the solutions of `reveal` sees this line or piece."""
    if item.role is Role.CODE or item.todo is None:
        return True
    return (item.role is Role.SOLUTION) == (item.todo in reveal)


def has_visible_lines(source: SourceFile, piece: Piece, reveal: Collection[str] = ()) -> bool:
    """Whether such a student sees more of the piece than its markers."""
    return any(
        item.text.strip() if isinstance(item, Line) else has_visible_lines(source, item, reveal)
        for item in source.items(piece)
        if is_visible(item, reveal)
    )


def _kept(source: SourceFile, piece: Piece, reveal: Collection[str]) -> Iterator[ExportedLine]:
    for item in source.items(piece):
        if not is_visible(item, reveal):
            continue
        if isinstance(item, Line):
            yield ExportedLine(item.text, item.number)
            continue
        if item.title and not item.is_top_level and has_visible_lines(source, item, reveal):
            yield _title_comment(source, item)
        yield from _kept(source, item, reveal)


def _title_comment(source: SourceFile, piece: Piece) -> ExportedLine:
    marker = source.text[piece.first - 1]
    indent = marker[: len(marker) - len(marker.lstrip())]
    stop = "" if piece.title.endswith((".", "?", "!")) else "."
    return ExportedLine(f"{indent}/* {piece.title}{stop} */", piece.first, is_title=True)


def _within(line: ExportedLine, piece: Piece) -> bool:
    return piece.first <= line.origin <= piece.last
