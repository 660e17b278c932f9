"""Reading a student's results, with what counts of them by the class's rules."""

from __future__ import annotations

import json
import sqlite3
import zlib
from dataclasses import replace
from datetime import datetime
from functools import lru_cache
from pathlib import Path

from ..grading.result import ModuleResult
from ..policy import NAME as POLICY
from ..policy import Attempt, Override, Policy, parse_policy, settle
from . import decisions
from .values import Module, Student, Version


def policy(database: sqlite3.Connection) -> Policy:
    (text,) = database.execute("SELECT policy FROM rules").fetchone()
    return _parsed(text)


@lru_cache(maxsize=4)
def _parsed(text: str) -> Policy:
    return parse_policy(text, Path(POLICY)) if text else Policy()


def modules(database: sqlite3.Connection) -> list[Module]:
    rows = database.execute("SELECT * FROM assignment ORDER BY number")
    return [Module(n, m, t, points, bool(optional)) for n, m, t, points, optional in rows]


def student(database: sqlite3.Connection, name: str, pictures: bool) -> Student:
    """One student; KeyError when there is none of that id."""
    found = database.execute("SELECT problem FROM submission WHERE id = ?", (name,)).fetchone()
    if found is None:
        raise KeyError(name)
    handed_in = versions(database, name)
    results = {n: [_result(database, v.key) for v in own] for n, own in handed_in.items()}
    attempts = {
        number: [
            Attempt(version.time, result.score if result else None)
            for version, result in zip(own, results[number], strict=True)
        ]
        for number, own in handed_in.items()
    }
    optional = {module.number for module in modules(database) if module.optional}
    overrides = _overrides(database, name)
    settled = settle(policy(database), name, attempts, optional, overrides)
    final: dict[str, ModuleResult | None] = {}
    for number, one in settled.items():
        result = results[number][one.attempt]
        if result is not None and pictures:
            key = handed_in[number][one.attempt].key
            result = result.with_pictures(_pictures(database, key))
        final[number] = result and replace(result, score=one.score)
    return Student(name, found[0], final, settled)


def versions(database: sqlite3.Connection, name: str) -> dict[str, list[Version]]:
    """What a student handed in, by assignment and in order."""
    found: dict[str, list[Version]] = {}
    for number, key, files, time in database.execute(
        "SELECT assignment, key, files, handed_in FROM grade"
        " WHERE submission = ? ORDER BY assignment, place",
        (name,),
    ):
        handed_in = None if time is None else datetime.fromisoformat(time)
        found.setdefault(number, []).append(Version(key, files, handed_in))
    return found


def _overrides(database: sqlite3.Connection, name: str) -> dict[str, Override]:
    rows = decisions.all_of(database, name)
    return {row.assignment: one for row in rows if (one := row.override()) is not None}


def _result(database: sqlite3.Connection, key: str) -> ModuleResult | None:
    row = database.execute("SELECT result FROM work WHERE key = ?", (key,)).fetchone()
    if row is None:
        return None
    try:
        return ModuleResult.from_json(json.loads(row[0]))
    except (ValueError, KeyError, TypeError) as error:
        raise sqlite3.DatabaseError(f"the result {key[:12]} cannot be read") from error


def _pictures(database: sqlite3.Connection, key: str) -> dict[int, str]:
    rows = database.execute("SELECT place, html FROM picture WHERE key = ?", (key,))
    try:
        return {i: zlib.decompress(html).decode() for i, html in rows}
    except (ValueError, TypeError, zlib.error) as error:
        raise sqlite3.DatabaseError(f"a picture of {key[:12]} cannot be read") from error
