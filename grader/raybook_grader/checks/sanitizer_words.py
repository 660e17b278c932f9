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
    a above accessing address alignment an and applying argument as assumption at be been before
    bool bound bounds by call cannot cast char constant deallocation declared does double element
    end evaluates execution expression exponent failed float for function has having highest in
    incorrect index indirectly infinity int into invalid is it its large left length load loaded
    long lvalue member misaligned misbehaved nan negated negation negative never no non nonnull not
    null object of offset one or out outside overflow overflowed passed passing pointer points
    positive produced program prototype range reached reference represent representable
    represented requires return returned returning right runtime shift short signed size specified
    store sub that the to too type unreachable unsigned value values variable vla was which while
    width with within without zero zeroed x bit bits 32 64 32-bit 64-bit double float struct union
    array const byte bytes insufficient space
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
