"""The list of all fragments, and of all identifiers: where each is shown, and what uses it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from html import escape
from itertools import groupby

from .book_nodes import Linker, Woven
from .identifiers import Definition


def fragment_list(woven: Woven, link: Linker) -> str:
    """Every fragment that is shown, by its title."""
    pieces = [p for p in woven.reader.pieces.values() if not p.is_root and not p.continuation]
    rows = []
    for piece in sorted(pieces, key=lambda p: (woven.title(p).lower(), p.slug)):
        title = _link(link.to(woven.reader.key(piece)), f"⟨{escape(woven.title(piece))}⟩")
        place = f"{piece.file}:{woven.reader.span(piece)[0]}"
        rows.append(f'<li>{title} <span class="rb-place">{place}</span></li>')
    return f'<ul class="rb-index">{"".join(rows)}</ul>'


def identifier_list(woven: Woven, link: Linker) -> str:
    """Every identifier, under its first letter."""
    parts = []
    for letter, own in groupby(woven.identifiers.all(), key=lambda d: d.name[0].upper()):
        rows = "".join(_identifier(woven, link, definition) for definition in own)
        parts.append(f'<p class="rubric">{letter}</p><ul class="rb-index">{rows}</ul>')
    return "".join(parts)


def _identifier(woven: Woven, link: Linker, definition: Definition) -> str:
    name = _link(link.to(definition.key, definition.anchor), f"<code>{definition.name}</code>")
    where = f'<span class="rb-place">{definition.kind}, {definition.file}</span>'
    users = woven.identifiers.used_in.get(definition, [])
    uses = ", ".join(_unique(_user(woven, link, key) for key in users))
    return f"<li>{name} {where}{f'<br>used in {uses}' if uses else ''}</li>"


def _user(woven: Woven, link: Linker, key: str) -> str:
    piece = woven.piece(key)
    title = escape(woven.title(piece))
    return _link(link.to(key), title if piece.is_root else f"⟨{title}⟩")


def _unique(texts: Iterable[str]) -> Iterator[str]:
    return iter(dict.fromkeys(texts))


def _link(address: str | None, html: str) -> str:
    return f'<a href="{address}">{html}</a>' if address else html
