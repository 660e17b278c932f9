"""What is wrong with a compilation database or a first picture, in words.

For the grader and for the student's own check alike.
"""

from __future__ import annotations

import json
import shlex
from collections.abc import Sequence
from itertools import pairwise
from pathlib import PurePosixPath
from typing import Any

import numpy as np

from ..judge.pixels import Image

_COLOURS = 3
"""Colours that a picture has at least; what the stubs draw, flat balls on black, has four."""


def compile_commands_faults(content: bytes, sources: Sequence[str]) -> list[str]:
    """The faults of a compile_commands.json that must know the files ``sources``; none if right."""
    try:
        entries = json.loads(content.decode("utf-8"))
    except (ValueError, RecursionError):
        return ["it is no JSON; make it with `make compile_commands.json`"]
    if not isinstance(entries, list) or not all(isinstance(entry, dict) for entry in entries):
        return ["it is no list of compile commands; make it with `make compile_commands.json`"]
    return [fault for source in sources for fault in _entry_faults(entries, source)]


def _entry_faults(entries: list[dict[str, Any]], source: str) -> list[str]:
    found = [entry for entry in entries if _names(entry.get("file"), source)]
    if not found:
        return [f"it does not say how {source} is compiled"]
    words = _words(found[0])
    if words is None:
        return [f"the entry of {source} has no command that can be read"]
    missing = [] if any(w.startswith("-std=") and w.endswith("99") for w in words) else ["-std=c99"]
    missing += [] if _includes_source(words) else ["-Isrc"]
    return [f"the command of {source} lacks {flag}" for flag in missing]


def _names(file: object, source: str) -> bool:
    return isinstance(file, str) and f"/{file}".endswith(f"/{source}")


def _words(entry: dict[str, Any]) -> list[str] | None:
    arguments, command = entry.get("arguments"), entry.get("command")
    if isinstance(arguments, list) and all(isinstance(word, str) for word in arguments):
        return arguments
    try:
        return shlex.split(command) if isinstance(command, str) else None
    except ValueError:
        return None


def _includes_source(words: Sequence[str]) -> bool:
    joined = [word[2:] for word in words if word.startswith("-I") and len(word) > 2]
    apart = [after for word, after in pairwise(words) if word == "-I"]
    return any(PurePosixPath(folder).name == "src" for folder in [*joined, *apart])


def picture_faults(pixels: Image, resolution: tuple[int, int]) -> list[str]:
    """The faults of a picture that must have this width and height; none if right."""
    height, width = pixels.shape[:2]
    if (width, height) != resolution:
        return [f"it has {width} x {height} pixels, expected {resolution[0]} x {resolution[1]}"]
    if not np.isfinite(pixels).all() or (pixels < 0).any():
        return ["some of its pixels are NaN, infinite or negative"]
    if len(np.unique(pixels.reshape(-1, pixels.shape[2]), axis=0)) < _COLOURS:
        return ["it shows nothing: hardly two of its pixels differ"]
    return []
