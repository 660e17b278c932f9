"""What stands above all else on a page: what its reader must know before the points."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Notice:
    """A title and a text; ``tone`` is one of `marks`: "good", "fair", "bad" or "ours"."""

    title: str
    text: str
    tone: str = "fair"


UNSAFE = Notice("Unsafe results.", "The students' code ran without a sandbox.", "bad")
"""Stands on the page of every student with such a result, and on the class page."""
