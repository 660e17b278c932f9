"""The same module in other words: what a second student would have written.

The functions do the same, to the last bit, but the compiler is given something else: own
functions have other names, there is a helper more, a constant more, and some files come from an
editor with other line ends.
"""

from __future__ import annotations

import random
import re

_OWN_FUNCTION = re.compile(rb"^static\s+(?:inline\s+)?[\w\s*]+?\b(\w+)\s*\(", re.MULTILINE)
_WINDOWS_SHARE = 0.1

_HELPER = b"""
/* Not needed any more. */
enum { my_limit_%(n)d = %(limit)d };

static inline float my_helper_%(n)d(float x)
{
    return x > %(limit)d ? %(limit)d : x;
}
"""


def reword(text: bytes, number: int, rng: random.Random) -> bytes:
    """Another text of the same meaning; no two numbers give the same one."""
    for name in sorted(set(_OWN_FUNCTION.findall(text))):
        if rng.random() < 0.5:
            text = re.sub(rb"(?<![\w.>])%s\b" % name, b"%s_%d" % (name, number), text)
    text += _HELPER % {b"n": number, b"limit": rng.randrange(1, 1_000_000)}
    return text.replace(b"\n", b"\r\n") if rng.random() < _WINDOWS_SHARE else text
