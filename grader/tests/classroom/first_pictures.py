"""Assignment 00: files that students made with the tools. The museum has none of it."""

from __future__ import annotations

import json
import random
from collections.abc import Sequence

import numpy as np
from versions import Version

from raybook_grader.course import ArtefactCheck, Assignment
from raybook_grader.judge.exr import encode_exr

_DATABASE, _PICTURE = "compile_commands.json", "first-picture.exr"


def first_pictures(
    assignment: Assignment, sources: Sequence[str], count: int, rng: random.Random
) -> list[Version]:
    """``count`` different versions: all that is asked for, nothing, then what lies between."""
    checks = {c.file: c for c in assignment.checks if isinstance(c, ArtefactCheck)}
    database, picture = checks[_DATABASE], checks[_PICTURE]
    assert picture.resolution is not None
    width, height = picture.resolution
    pool: list[Version] = []
    for number in range(count):
        right = number == 0 or rng.random() < 0.8
        files = {_PICTURE: _picture((width + (not right), height), number)}
        score = picture.points if right else 0.0
        if number == 0 or rng.random() < 0.8:
            files[_DATABASE] = _commands(sources, number)
            score += database.points
        words = "a picture" if right else "a picture of a wrong size"
        pool.append(Version(f"00/{words} {number}", files, score=score))
    pool[1:2] = [Version("00/nothing", {}, score=0.0)] if count > 1 else []
    return pool


def _picture(resolution: tuple[int, int], seed: int) -> bytes:
    width, height = resolution
    rng = np.random.default_rng(seed)
    return encode_exr(rng.random((height, width, 3), dtype=np.float32))


def _commands(sources: Sequence[str], number: int) -> bytes:
    home = f"/home/student{number}/raybook"
    entries = [
        {"directory": home, "file": path, "arguments": ["cc", "-std=c99", "-Isrc", "-c", path]}
        for path in sources
    ]
    return json.dumps(entries).encode()
