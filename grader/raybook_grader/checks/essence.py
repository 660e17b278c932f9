"""What a compiler sees of a C file: its text without comments and white space."""

from __future__ import annotations

import re

# Each branch succeeds at its first character, closed or not: no text makes this slow.
_TOKEN = re.compile(
    rb"""
    (?P<comment> /\*.*?(?:\*/|\Z) | //(?:[^\n\\]|\\.)* )
  | (?P<literal> "(?:[^"\\\n]|\\.)*"? | '(?:[^'\\\n]|\\.)*'? )
  | (?P<space> \s+ )
  | (?P<other> [^\s"'/]+ | / )
    """,
    re.DOTALL | re.VERBOSE,
)


def essence(text: bytes) -> bytes:
    """The text without comments and white space; equal for files that differ in these at most."""
    kept = (m["literal"] or m["other"] for m in _TOKEN.finditer(text))
    return b"".join(part for part in kept if part)
