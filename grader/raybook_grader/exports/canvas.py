"""Canvas: a gradebook CSV to import (Gradebook, Import).

Format: Canvas's Instructor Guide, "How do I import grades in the Gradebook?", and what Canvas
itself reads (canvas-lms, lib/gradebook_importer.rb): the columns of the student come first and
end with Section; the row "Points Possible" comes before the students; each further column is an
assignment, "Title (id)" if Canvas has it already. A student is found by ID, else by SIS User ID,
else by SIS Login ID. An empty cell means "no grade".

Other assignments' columns of the exported file are left out: importing them again would undo what
was graded in Canvas since.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from ..database import Module
from ..errors import BadInput
from .cells import Value, number, table
from .gradebook import Gradebook, Row
from .points import factor, scaled
from .roster import Matching, Roster, match

_STUDENT = ("Student", "ID", "SIS User ID", "SIS Login ID", "Section")
_KEYS = ("SIS Login ID", "SIS User ID", "ID")
_POINTS = "Points Possible"
_ASSIGNMENT_ID = re.compile(r" \(\d+\)$")


@dataclass(frozen=True)
class Column:
    """An assignment's column: its header, and what our scores are multiplied by."""

    module: Module
    header: str
    points: str
    by: float
    is_new: bool


def canvas_export(
    gradebook: Gradebook,
    roster: Roster | None,
    key: str | None,
    names: Mapping[str, str],
    scale: bool,
) -> tuple[str, list[str]]:
    """The whole file, and what to tell.

    Without a roster the submissions' ids are taken for login ids. ``key`` names the one column
    that tells students apart; ``names`` the columns of assignments that are called otherwise.
    """
    if roster is None:
        return _without_roster(gradebook, names), []
    last = _last_student_column(roster)
    points_row = next((r for r in roster.rows if _POINTS in r[0]), [""] * len(roster.header))
    columns = [_column(m, roster, points_row, last, names, scale) for m in gradebook.modules]
    students = {i: r for i, r in enumerate(roster.rows) if _is_student(r, last)}
    matching = match(gradebook.rows, {i: _keys(roster, row, key) for i, row in students.items()})
    lines: list[list[Value]] = [
        [*roster.header[: last + 1], *(column.header for column in columns)],
        [f"    {_POINTS}", *[""] * last, *(column.points for column in columns)],
    ]
    for place, row in students.items():
        lines.append([*row[: last + 1], *_scores(matching.by_place.get(place), columns)])
    return table(lines, roster.delimiter), _notes(matching, columns, len(students))


def _without_roster(gradebook: Gradebook, names: Mapping[str, str]) -> str:
    columns = [
        Column(m, names.get(m.number, _title(m)), number(m.points), 1.0, True)
        for m in gradebook.modules
    ]
    lines: list[list[Value]] = [
        [*_STUDENT, *(column.header for column in columns)],
        [f"    {_POINTS}", "", "", "", "", *(column.points for column in columns)],
    ]
    for row in gradebook.rows:
        lines.append([row.id, "", "", row.id, "", *_scores(row, columns)])
    return table(lines)


def _last_student_column(roster: Roster) -> int:
    """Where Section is: Canvas counts what is behind it as assignments."""
    if not roster.header[0].startswith(("Student", "LastName")):
        raise BadInput(
            f"{roster.file}: its first column is {roster.header[0]!r}, expected 'Student': "
            "a file from Canvas's Gradebook, Export"
        )
    roster.need("ID")
    return roster.need("Section")


def _is_student(row: Sequence[str], last: int) -> bool:
    """Not the points, nor the row that says which assignments are posted by hand."""
    return _POINTS not in row[0] and any(cell.strip() for cell in row[: last + 1])


def _keys(roster: Roster, row: Sequence[str], key: str | None) -> list[str]:
    if key is not None:
        return [row[roster.need(key)]]
    places = [place for name in _KEYS if (place := roster.column(name)) is not None]
    words = [row[place] for place in places]
    # A login may be an address; submissions are often named by what is before the @.
    return words + [word.split("@")[0] for word in words if "@" in word]


def _column(
    module: Module, roster: Roster, points: Sequence[str], last: int, names: Mapping[str, str],
    scale: bool,
) -> Column:  # fmt: skip
    wanted = {_title(module), f"{module.number} {module.module}", module.title, module.module}
    if module.number in names:
        wanted = {names[module.number]}
    folded = {name.casefold() for name in wanted}
    fits = [
        i
        for i, header in enumerate(roster.header)
        if i > last and {header.casefold(), _bare(header)} & folded
    ]
    if len(fits) > 1:
        both = " and ".join(repr(roster.header[i]) for i in fits)
        raise BadInput(
            f"{roster.file}: {both} may both be assignment {module.number}, expected one; "
            f"say which by --column '{module.number}=...'"
        )
    if fits:
        header, worth = roster.header[fits[0]], points[fits[0]]
        by = factor(module.points, worth, f"{roster.file}: {header}", scale)
        return Column(module, header, worth or number(module.points), by, False)
    return Column(
        module, names.get(module.number, _title(module)), number(module.points), 1.0, True
    )


def _bare(header: str) -> str:
    return _ASSIGNMENT_ID.sub("", header).casefold()


def _title(module: Module) -> str:
    return f"{module.number} {module.title}"


def _scores(row: Row | None, columns: Sequence[Column]) -> list[Value]:
    if row is None:
        return [None] * len(columns)
    marks = [row.marks.get(column.module.number) for column in columns]
    return [scaled(m.score, c.by) if m else None for m, c in zip(marks, columns, strict=True)]


def _notes(matching: Matching, columns: Sequence[Column], students: int) -> list[str]:
    notes = [f"not in the file: {name}" for name in matching.unmatched]
    if absent := students - len(matching.by_place):
        notes.append(f"{absent} of {students} students have no submission: left empty")
    notes += [f"new in Canvas: column {c.header!r}" for c in columns if c.is_new]
    return notes
