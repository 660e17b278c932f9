"""Telling a module that nobody has begun from one that somebody has."""

from __future__ import annotations

from functools import cache
from pathlib import Path

from ..literate.export import export
from ..literate.markers import parse
from .essence import essence


@cache
def stub_text(root: Path, path: str) -> str:
    """The student edition of a source file of the course: what everybody begins with."""
    source = parse(path, (root / path).read_text(encoding="utf-8"))
    return export(source).text


def is_stub(content: bytes, stub: str) -> bool:
    """Whether the two differ in white space and comments at most.

    A file that still has both branches of a `TODO_` conditional is no stub: what counts is what
    the compiler makes of it, and without a definition that is the first branch.
    """
    return essence(content) == essence(stub.encode())
