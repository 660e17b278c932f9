"""Which words of a sanitizer's report may be believed to be its own.

A program can print a report of its own making and quote in it what is none of its student's
business: a hidden driver, its cases.
"""

from __future__ import annotations

import re
from collections.abc import Iterable

_WORD = re.compile(r"\w+")
_NUMBER = re.compile(r"\d[\de]{0,20}")
_LENGTH = 200

_VOCABULARY = frozenset(
    re.findall(
        r"\S+",
        """
        a above access accessing addition address aligned alignment an and applying argument
        arguments array as assumption at base be been before binding bit bits bool bound
        bounds builtin by byte bytes call cannot cast changed char check clz const constant
        control conversion ctz deallocation declared defined destination division does
        double downcast during dynamic element end evaluates execution exponent expression
        failed float flow for from function has having here highest implicit in incorrect
        index indirectly infinity insufficient int integer integrity into invalid is it its
        itself large left length load loaded located long lvalue member misaligned
        misalignment misbehaved nan negate negated negation negative never no non nonnull
        nonzero not null nullptr object of offset on one operation or out outside overflow
        overflowed passed passing places pointer points positive produced program prototype
        range reached reference represent representable represented requires return returned
        returning right runtime shift short signed size space specified store struct sub
        subtraction that the this to too type union unreachable unsigned upcast valid value
        values variable virtual vla was which while width with within without x zero zeroed
        """,
    )
)
"""The words of UndefinedBehaviorSanitizer's own sentences."""


def known_words(text: str, own: Iterable[bytes]) -> str:
    """The text with what is no number, nor a word of UBSan's or of these files, left out."""
    mine = {word for content in own for word in _WORD.findall(content.decode("utf-8", "replace"))}

    def keep(word: re.Match[str]) -> str:
        known = word[0] in mine or word[0].lower() in _VOCABULARY or _NUMBER.fullmatch(word[0])
        return word[0] if known else "..."

    return _WORD.sub(keep, text)[:_LENGTH]
