"""Is every line of every module shown exactly once, and every exercise set exactly once?"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ..literate.pieces import Piece
from .book_nodes import Woven
from .editions import BookLine
from .places import Place, Places


def coverage_faults(woven: Woven, places: Places) -> list[str]:
    """One message for each piece or exercise that is missing or doubled; none if all is well."""
    return [*_piece_faults(woven, places), *_exercise_faults(woven, places)]


def missing_files(woven: Woven, places: Places) -> list[str]:
    """The modules of which nothing at all is shown."""
    shown = {p.file for key, p in woven.reader.pieces.items() if places.pieces.get(key)}
    return [name for name in woven.reader.files if name not in shown]


def _piece_faults(woven: Woven, places: Places) -> Iterator[str]:
    for key, piece in woven.reader.pieces.items():
        shown = places.pieces.get(key, [])
        if len(shown) == 1:
            continue
        lines = own_lines(woven, piece)
        where = ", ".join(f"{piece.file}:{span}" for span in spans(lines)) or piece.file
        if not shown:
            how = f"{{source}} {piece.file}" if piece.is_root else f"{{fragment}} {piece.slug}"
            yield f"{where}: shown nowhere; ':::{how}' would show it"
        else:
            yield f"{where}: shown {len(shown)} times: {_listed(shown)}"


def _exercise_faults(woven: Woven, places: Places) -> Iterator[str]:
    for todo in woven.reader.tree.todos.values():
        set_at = places.exercises.get(todo.name, [])
        if not set_at:
            yield f"{todo.file}:{todo.line}: exercise {todo.name} is set nowhere"
        elif len(set_at) > 1:
            yield f"{todo.file}:{todo.line}: exercise {todo.name} is set at {_listed(set_at)}"


def own_lines(woven: Woven, piece: Piece) -> list[int]:
    """The piece's own lines, in the checkout's file."""
    items = woven.reader.items(piece)
    return [item.origin for item in items if isinstance(item, BookLine)]


def spans(lines: Sequence[int]) -> Iterator[str]:
    """ "3-5" and "9" for lines 3, 4, 5 and 9."""
    if not lines:
        return
    first = last = lines[0]
    for line in [*lines[1:], 0]:
        if line == last + 1:
            last = line
            continue
        yield f"{first}-{last}" if last > first else f"{first}"
        first = last = line


def _listed(places: Sequence[Place]) -> str:
    return ", ".join(map(str, places))
