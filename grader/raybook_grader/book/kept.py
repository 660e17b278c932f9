"""Verdicts that are kept: what was found sound is sound until something changes that it rests on.

Only "sound" is ever kept. The key of a verdict is a hash of everything that it rests on: files,
programs, libraries. `make book FRESH=1` forgets all of them.
"""

from __future__ import annotations

import hashlib
import importlib.metadata
import json
import subprocess
import sys
from collections.abc import Iterable
from functools import cache
from pathlib import Path

from ..files import write_text

_SOURCES = ("Makefile", ".setup", "assignments", "docs", "grader/raybook_grader",
            "grader/pyproject.toml", "scenes", "src")  # fmt: skip
_MADE = ("build/bench", "build/node/lock.stamp")
_TOOLS = (("gcc", "--version"), ("make", "--version"), ("ctags", "--version"),
          ("unifdef", "-V"), ("node", "--version"), ("chromium", "--version"),
          ("qpdf", "--version"), ("pdfinfo", "-v"), ("pdftotext", "-v"),
          ("fc-list", ":", "file"))  # fmt: skip


class Kept:
    """The verdicts in a folder; of each name the last one."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    def has(self, name: str, key: str) -> bool:
        """Whether this very content was found sound."""
        file = self._folder / name
        return file.is_file() and file.read_text(encoding="utf-8") == key

    def keep(self, name: str, key: str) -> None:
        self._folder.mkdir(parents=True, exist_ok=True)
        write_text(self._folder / name, key)


def key_of(*parts: object) -> str:
    """A hash of what can be written as JSON."""
    return hashlib.sha256(json.dumps(parts, sort_keys=True).encode()).hexdigest()


def digests(folder: Path) -> dict[str, str]:
    """The hash of every file in a folder, by its name there."""
    return {
        file.relative_to(folder).as_posix(): hashlib.sha256(file.read_bytes()).hexdigest()
        for file in sorted(folder.rglob("*"))
        if file.is_file() and "__pycache__" not in file.parts
    }


def sources_key(root: Path, names: Iterable[str] = (*_SOURCES, *_MADE)) -> str:
    """A hash of these files and folders of the checkout; by default all that the book is of."""
    return key_of({name: _content(root / name) for name in names}, tools_key())


def _content(path: Path) -> dict[str, str]:
    if path.is_file():
        return {"": hashlib.sha256(path.read_bytes()).hexdigest()}
    return digests(path)


@cache
def tools_key() -> str:
    """A hash of the versions of everything that has a hand in the book."""
    packages = {d.name: d.version for d in importlib.metadata.distributions()}
    return key_of(sys.version, packages, [_answer(command) for command in _TOOLS])


def _answer(command: tuple[str, ...]) -> str:
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=False)
    except FileNotFoundError:
        return ""
    return "\n".join(sorted((done.stdout + done.stderr).splitlines()))
