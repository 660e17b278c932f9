"""The report for people, one page that opens offline, and `similarity.json` for programs."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from jinja2 import Environment, PackageLoader, StrictUndefined

from ..files import write_text
from .document import Document
from .pair import Pair, Part
from .search import Findings
from .settings import LENGTH

VERSION = 1
PAGE = "index.html"
JSON = "similarity.json"
SHOWN = 40
"""Pairs of one module whose texts are in the page; the others come with their numbers only."""


@dataclass(frozen=True)
class Piece:
    """Text between marks (``place`` is None), or a marked part and where its counterpart is."""

    text: str
    place: int | None = None
    other: int = 0


@dataclass(frozen=True)
class File:
    """One file of one side: its path, its line numbers and its text in pieces."""

    path: str
    numbers: str
    pieces: tuple[Piece, ...]


@dataclass(frozen=True)
class Shown:
    """A pair in the page; ``sides`` is empty if only its numbers are shown."""

    pair: Pair
    sides: tuple[tuple[File, ...], ...]


def write_report(
    folder: Path, course: str, findings: Sequence[Findings], threshold: float
) -> tuple[Path, Path]:
    """Write both files into ``folder``, each complete or not at all."""
    environment = Environment(
        loader=PackageLoader(__package__ or "", "templates"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters["percent"] = lambda share: "none" if share is None else f"{share:.0%}"
    modules = [(found, [_shown(i, p) for i, p in enumerate(found.alike)]) for found in findings]
    page = environment.get_template("similarity.html").render(
        course=course, modules=modules, threshold=threshold, length=LENGTH
    )
    write_text(folder / PAGE, page)
    values = {"version": VERSION, "course": course, "threshold": threshold, "tokens": LENGTH}
    values |= {"modules": [_module(found) for found in findings]}
    write_text(folder / JSON, json.dumps(values, indent=1) + "\n")
    return folder / PAGE, folder / JSON


def _shown(place: int, pair: Pair) -> Shown:
    if place >= SHOWN:
        return Shown(pair, ())
    first, second = pair.parts
    return Shown(pair, (_files(pair.a, first), _files(pair.b, second)))


def _files(document: Document, parts: Sequence[Part]) -> tuple[File, ...]:
    files = []
    for i, (path, text) in enumerate(document.texts):
        lines = text.count("\n") + (not text.endswith("\n"))
        numbers = "\n".join(str(n) for n in range(1, lines + 1))
        files.append(File(path, numbers, tuple(_pieces(text, i, parts))))
    return tuple(files)


def _pieces(text: str, file: int, parts: Sequence[Part]) -> list[Piece]:
    pieces = []
    done = 0
    for place, part in enumerate(parts):
        if part.text != file:
            continue
        start = max(part.start, done)  # two parts may share their ends
        pieces += [Piece(text[done:start]), Piece(text[start : part.end], place, part.other)]
        done = max(done, part.end)
    return [*pieces, Piece(text[done:])]


def _module(found: Findings) -> dict[str, Any]:
    return {
        "assignment": found.assignment.number,
        "module": found.assignment.module,
        "compared": found.compared,
        "pairs": found.pairs,
        "median": _round(found.median),
        "highest_below_threshold": _round(found.next),
        "alike": [_pair(pair, place < SHOWN) for place, pair in enumerate(found.alike)],
        "left_out": [{"id": name, "reason": reason} for name, reason in found.left_out],
    }


def _pair(pair: Pair, with_parts: bool) -> dict[str, Any]:
    """``parts`` is null for pairs that are not in the page with their texts."""
    first, second = pair.parts if with_parts else ([], [])
    return {
        "similarity": _round(pair.similarity),
        "a": {"id": pair.a.owner.id, "share": _round(pair.share_a)},
        "b": {
            "id": pair.b.owner.id,
            "earlier": pair.b.owner.origin or None,
            "share": _round(pair.share_b),
        },
        "parts": [
            {"a": _lines(pair.a, part), "b": _lines(pair.b, second[part.other])} for part in first
        ]
        if with_parts
        else None,
    }


def _lines(document: Document, part: Part) -> dict[str, Any]:
    path, text = document.texts[part.text]
    first = text.count("\n", 0, part.start) + 1
    return {"file": path, "first": first, "last": first + text.count("\n", part.start, part.end)}


def _round(value: float | None) -> float | None:
    return None if value is None else round(value, 3)
