"""The table of assignments in the student edition's README.md, made from their own files."""

from __future__ import annotations

import tomllib
from collections.abc import Iterable

from .check import Assignment

PLACE = "<!-- the table of assignments -->"
"""The line of the text that the table takes the place of."""


def with_table(text: str, assignments: Iterable[Assignment]) -> str:
    """The text with the table in its place; unchanged if it has none."""
    return text.replace(PLACE, _table(assignments)) if PLACE in text else text


def _table(assignments: Iterable[Assignment]) -> str:
    rows = ["| assignment | points | you write |", "| --- | --- | --- |"]
    return "\n".join([*rows, *map(_row, assignments)])


def _row(assignment: Assignment) -> str:
    values = tomllib.loads(assignment.text)
    title = values.get("title", assignment.folder.rpartition("/")[2])
    points = f"{values.get('points', '')}{' (optional)' if values.get('optional') else ''}"
    files = ", ".join(f"`{path}`" for path in assignment.owned)
    name = f"[{assignment.number} {title}]({assignment.folder}/handout.md)"
    return f"| {name} | {points} | {files} |"
