"""A plain table: one row a submission, two columns a module."""

from __future__ import annotations

from .cells import Value, table
from .gradebook import Gradebook, Row


def csv_export(gradebook: Gradebook) -> str:
    """The whole file. An unknown score is an empty cell."""
    header: list[Value] = ["submission", "score", "max_score", "problem"]
    for module in gradebook.modules:
        name = f"{module.number} {module.module}"
        header += [name, f"{name} verdict"]
    return table([header, *(_row(row, gradebook) for row in gradebook.rows)])


def _row(row: Row, gradebook: Gradebook) -> list[Value]:
    values: list[Value] = [row.id, row.score, row.max_score, row.problem]
    for module in gradebook.modules:
        mark = row.marks.get(module.number)
        values += [mark.score, mark.verdict] if mark else [None, None]
    return values
