"""Text as it is safe to print and to show, whoever wrote it."""

from __future__ import annotations


def visible(text: str, keep: str = "\n\t") -> str:
    """Without characters that clear a terminal, or hide and reorder others."""
    return "".join(c if c.isprintable() or c in keep else "\N{REPLACEMENT CHARACTER}" for c in text)
