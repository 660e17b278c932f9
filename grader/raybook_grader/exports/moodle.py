"""Moodle: the offline grading worksheet of one assignment, filled in.

Format: Moodle docs, "Assignment settings", Feedback types, "Offline grading worksheet", and what
Moodle itself reads (moodle, mod/assign/feedback/offline): the columns Identifier, Grade and "Last
modified (grade)" have to be there as they were downloaded; "Feedback comments" is HTML. An empty
grade changes nothing in Moodle, and one above "Maximum Grade" is dropped without a word.
"""

from __future__ import annotations

from collections.abc import Sequence
from html import escape

from ..errors import BadInput
from .cells import Value, number, table
from .gradebook import Gradebook, Mark, Row
from .points import factor, scaled
from .roster import Matching, Roster, match

_PASSED = ("passed", "not run", "internal-error")
_KEYS = ("Identifier", "Email address", "ID number", "Username", "Full name")


def moodle_export(
    gradebook: Gradebook, roster: Roster | None, key: str | None, scale: bool
) -> tuple[str, list[str]]:
    """The whole file, and what to tell. Rows without a known grade stay as they were."""
    if roster is None:
        raise BadInput(
            "the moodle format needs --roster: the worksheet from the assignment's page, "
            "Download grading worksheet"
        )
    grade, _ = roster.need("Grade"), roster.need("Identifier")
    roster.need("Last modified (grade)")
    most, comments = roster.column("Maximum Grade"), roster.column("Feedback comments")
    keys = {i: _keys(roster, row, key) for i, row in enumerate(roster.rows)}
    matching = match(gradebook.rows, keys)
    lines: list[list[Value]] = [list(roster.header)]
    for i, cells in enumerate(roster.rows):
        line: list[Value] = list(cells)
        row = matching.by_place.get(i)
        if row is not None:
            worth = cells[most] if most is not None else ""
            where = f"{roster.file}: the assignment"
            line[grade] = scaled(row.score, factor(row.max_score, worth, where, scale))
            if row.score is not None and comments is not None:
                line[comments] = _comments(row, gradebook)
        lines.append(line)
    return table(lines, roster.delimiter), _notes(matching, len(roster.rows))


def _keys(roster: Roster, row: Sequence[str], key: str | None) -> list[str]:
    if key is not None:
        return [row[roster.need(key)]]
    words = [row[place] for name in _KEYS if (place := roster.column(name)) is not None]
    # "Participant 123": folders that Moodle makes for a download have the number in their names.
    words += [word.split()[-1] for word in words[:1] if word.strip()]
    return words + [word.split("@")[0] for word in words if "@" in word]


def _comments(row: Row, gradebook: Gradebook) -> str:
    lines = [row.problem] if row.problem else []
    for module in gradebook.modules:
        mark = row.marks.get(module.number)
        if mark is not None:
            lines.append(f"{module.number} {module.module}: {_words(mark)}")
    return "".join(f"<p>{escape(line)}</p>" for line in lines)


def _words(mark: Mark) -> str:
    score = "no score" if mark.score is None else number(mark.score)
    words = f"{score} of {number(mark.max_score)}, {mark.verdict}."
    failed = [str(check["name"]) for check in mark.checks if check["status"] not in _PASSED]
    if mark.message:
        words += f" {mark.message}."
    return words + (f" Not passed: {', '.join(failed)}." if failed else "")


def _notes(matching: Matching, students: int) -> list[str]:
    notes = [f"not in the file: {name}" for name in matching.unmatched]
    if absent := students - len(matching.by_place):
        notes.append(f"{absent} of {students} students of the worksheet have no submission")
    return notes
