"""A C file as one symbol a token: the same for a copy with other names, comments and layout.

Names of things become one symbol, so do numbers, strings and built-in types. Qualifiers, comments
and what includes headers vanish; keywords and signs stay, and `->` is a `.`. Every branch of the
pattern succeeds at its first character, so no text makes it slow.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

_TOKEN = re.compile(
    r"""
    (?P<skip> \s+ | /\*.*?(?:\*/|\Z) | //(?:[^\n\\]|\\.)* | \#[ \t]*(?!define)(?:[^\n\\]|\\.)* )
  | (?P<string> "(?:[^"\\\n]|\\.)*"? | '(?:[^'\\\n]|\\.)*'? )
  | (?P<number> \.?[0-9](?:[eEpP][+-]|[\w.])* )
  | (?P<name> [^\W\d]\w* )
  | (?P<sign> -> | . )
    """,
    re.DOTALL | re.VERBOSE,
)

_NAME, _NUMBER, _STRING, _TYPE = "v", "n", "s", "t"
_DROPPED = frozenset(
    ("auto", "const", "extern", "inline", "register", "restrict", "static", "volatile")
)
_TYPES = frozenset((
    "bool", "char", "double", "float", "int", "int32_t", "int64_t", "long", "short", "signed",
    "size_t", "uint32_t", "uint64_t", "unsigned", "_Bool",
))  # fmt: skip
_KEYWORDS = {
    word: chr(0x100 + i)
    for i, word in enumerate((
        "break", "case", "continue", "default", "do", "else", "enum", "for", "goto", "if",
        "return", "sizeof", "struct", "switch", "typedef", "union", "void", "while",
    ))
}  # fmt: skip


@dataclass(frozen=True)
class Tokens:
    """``spans[i]`` is where in the text the i-th symbol comes from: (start, end)."""

    symbols: str
    spans: tuple[tuple[int, int], ...]


def tokenize(text: str) -> Tokens:
    """The symbols of a file."""
    symbols: list[str] = []
    spans: list[tuple[int, int]] = []
    for found in _TOKEN.finditer(text):
        symbol = _symbol(found)
        if symbol:
            symbols.append(symbol)
            spans.append(found.span())
    return Tokens("".join(symbols), tuple(spans))


def _symbol(found: re.Match[str]) -> str:
    """One character, or none for what does not count."""
    word = found[0]
    match found.lastgroup:
        case "string":
            return _STRING
        case "number":
            return _NUMBER
        case "name":
            if word in _DROPPED:
                return ""
            return _TYPE if word in _TYPES else _KEYWORDS.get(word, _NAME)
        case "sign":
            return "." if word == "->" else word
    return ""
