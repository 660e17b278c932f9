"""C as HTML: a line of markup for each line of code, coloured, with a link on every known name."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from html import escape

from pygments.token import STANDARD_TYPES, _TokenType

from .identifiers import c_tokens, is_name

LinkName = Callable[[str], str | None]
"""The address of a name's definition, if it has one."""


COLOURED = frozenset(
    ("k", "kr", "kc", "kt", "c", "c1", "cm", "s", "se", "sc", "mi", "mf", "mh", "cp", "cpf")
)
"""The token types, by Pygments' short names, that the style sheet gives a colour; no other needs
an element, of which a page has thousands."""


def highlight(lines: Sequence[str], link: LinkName) -> list[str]:
    """The lines as HTML. What belongs together over lines, a comment, is coloured as one."""
    marked = [""] * len(lines)
    number = 0
    for token, value in c_tokens("\n".join(lines)):
        for part in _parts(value):
            if part == "\n":
                number += 1
            else:
                marked[number] += _marked(token, part, link)
    return marked


def _parts(value: str) -> Iterator[str]:
    """The value cut at its line ends: no element may cross a line."""
    for number, part in enumerate(value.split("\n")):
        if number:
            yield "\n"
        if part:
            yield part


def _marked(token: _TokenType, text: str, link: LinkName) -> str:
    body = escape(text)
    address = link(text) if is_name(token) else None
    if address:
        body = f'<a class="rb-id" href="{escape(address)}">{body}</a>'
    name = _class(token)
    return f'<span class="{name}">{body}</span>' if name in COLOURED and text.strip() else body


def _class(token: _TokenType) -> str:
    """Pygments' short name of a token type, or of the nearest type above it that has one."""
    kind: _TokenType | None = token
    while kind is not None and kind not in STANDARD_TYPES:
        kind = kind.parent
    return STANDARD_TYPES.get(kind, "") if kind is not None else ""
