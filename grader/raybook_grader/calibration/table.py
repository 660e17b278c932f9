"""The table of a calibration: as JSON for other programs, as Markdown for people."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from .confusion import Row
from .false_fails import Count
from .naming import Naming


@dataclass(frozen=True)
class ModuleTable:
    """All of one assignment. ``chance`` is by image check; ``spoken`` are right modules that the
    diagnosis wrongly says something of."""

    number: str
    module: str
    rows: tuple[Row, ...]
    chance: Mapping[str, Count]
    namings: tuple[Naming, ...]
    spoken: tuple[str, ...]


def to_json(tables: Sequence[ModuleTable]) -> dict[str, Any]:
    """All modules together, and each under "modules" with the same keys."""
    return {**_figures(tables), "modules": {t.module: _figures([t]) for t in tables}}


def is_good(tables: Sequence[ModuleTable]) -> bool:
    """Whether everything is as it should be."""
    return (
        all(row.as_meant for t in tables for row in t.rows)
        and not any(count.failed for t in tables for count in t.chance.values())
        and not any(t.spoken for t in tables)
    )


def summary(tables: Sequence[ModuleTable]) -> str:
    """One line."""
    f = _figures(tables)
    chance = f["false_fails"]
    named = f["diagnosis"]
    return (
        f"mistakes rejected {f['mistakes']['rejected']} of {f['mistakes']['total']}, "
        f"alternatives accepted {f['alternatives']['accepted']} of {f['alternatives']['total']}, "
        f"false fails {chance['failed']} of {chance['gradings']} gradings "
        f"({chance['disjoint']} on disjoint seeds), "
        f"diagnosis right first {named['top1']}, among two {named['top2']} of {named['total']}"
    )


def _figures(tables: Sequence[ModuleTable]) -> dict[str, Any]:
    rows = [row for t in tables for row in t.rows]
    wrong = [row for row in rows if not row.exhibit.is_right]
    right = [row for row in rows if row.exhibit.is_right]
    counts = [count for t in tables for count in t.chance.values()]
    trials = [naming for t in tables for naming in t.namings]
    return {
        "mistakes": {
            "total": len(wrong),
            "rejected": sum(row.rejected for row in wrong),
            "missed": [row.exhibit.name for row in wrong if not row.rejected],
        },
        "alternatives": {
            "total": len(right),
            "accepted": sum(row.accepted for row in right),
            "refused": [row.exhibit.name for row in right if not row.accepted],
        },
        "diagnosis": {
            "total": len(trials),
            "top1": sum(naming.first for naming in trials),
            "top2": sum(naming.among_two for naming in trials),
            "spoken_of_right": [name for t in tables for name in t.spoken],
        },
        "false_fails": {
            "gradings": sum(count.gradings for count in counts),
            "failed": sum(count.failed for count in counts),
            "disjoint": sum(count.disjoint for count in counts),
            "disjoint_failed": sum(count.disjoint_failed for count in counts),
        },
        "surprises": [row.exhibit.name for row in rows if not row.as_meant],
    }


def to_markdown(tables: Sequence[ModuleTable]) -> str:
    """A section for each module."""
    lines = ["# Calibration", "", summary(tables), ""]
    for table in tables:
        lines += [f"## {table.number} {table.module}", "", *_rows(table), *_chance(table)]
        lines += _namings(table)
    return "\n".join(lines)


def _rows(table: ModuleTable) -> Iterable[str]:
    yield "| module | expected | points | failed | pictures |"
    yield "| --- | --- | --- | --- | --- |"
    for row in table.rows:
        score = "?" if row.result.score is None else f"{row.result.score:g}"
        pictures = "; ".join(f"{n} of {row.looks}" for n in row.pictures.values())
        mark = "" if row.as_meant else " **not as meant**"
        yield (
            f"| {row.exhibit.slug} | {'right' if row.exhibit.is_right else 'wrong'} | {score} | "
            f"{'; '.join(row.failed)}{mark} | {pictures} |"
        )
    yield ""


def _chance(table: ModuleTable) -> Iterable[str]:
    for name, count in table.chance.items():
        yield (
            f"{name}: {count.failed} of {count.gradings} gradings of right pictures fail; "
            f"{count.disjoint} on disjoint seeds, {count.drawn} drawn from {count.pool} seeds."
        )
        yield ""


def _namings(table: ModuleTable) -> Iterable[str]:
    if not table.namings:
        return
    yield "| left out | is | named |"
    yield "| --- | --- | --- |"
    for naming in table.namings:
        yield f"| {naming.module} | {naming.mistake} | {', '.join(naming.said) or 'nothing'} |"
    yield ""
