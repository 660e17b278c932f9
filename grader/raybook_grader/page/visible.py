"""Text that a submission can influence, made so that nothing in it hides or reorders the rest."""

from __future__ import annotations

import re
import unicodedata

LONGEST = 30_000
"""Characters of one text on a page; a longer one is cut, and says so."""
MOST_MARKS = 3
"""Combining marks in a row; more of them are drawn over the lines above and below."""

_PLAIN = re.compile(r"[\t\n -~]*")
# Control, format (bidirectional ones too), lone surrogates, private use, line separators.
_HIDDEN = ("Cc", "Cf", "Cs", "Co", "Cn", "Zl", "Zp")


def visible(text: str) -> str:
    """The text with every character that would not be seen written as ``[U+202E]``.

    Tabs and line feeds stay; what is too long is cut. The result is plain text, still to be
    escaped.
    """
    text = shortened(text, LONGEST)
    if _PLAIN.fullmatch(text):
        return text
    shown: list[str] = []
    marks = 0
    for character in text:
        category = unicodedata.category(character)
        marks = marks + 1 if category in ("Mn", "Me") else 0
        hidden = category in _HIDDEN and character not in "\t\n"
        shown.append(f"[U+{ord(character):04X}]" if hidden or marks > MOST_MARKS else character)
    return shortened("".join(shown), LONGEST)


def shortened(text: str, longest: int) -> str:
    """At most about so many characters, and how many are left out."""
    left_out = len(text) - longest
    return text if left_out <= 0 else f"{text[:longest]} ... and {left_out} more characters"
