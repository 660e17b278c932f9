"""The list of all fragments, and of all identifiers: where each is shown, and what uses it."""

from __future__ import annotations

from collections.abc import Iterable
from html import escape
from itertools import groupby

from .book_nodes import Linker, Woven
from .identifiers import Definition

_MOST_USERS = 6  # what everything uses is no news


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
    rows = []
    shown = [d for d in woven.identifiers.all() if not d.name.startswith("_")]
    for letter, own in groupby(shown, key=lambda d: d.name[0].upper()):
        rows.append(f'<li class="rb-letter">{letter}</li>')
        rows += [_identifier(woven, link, definition) for definition in own]
    return f'<ul class="rb-index">{"".join(rows)}</ul>'


def _identifier(woven: Woven, link: Linker, definition: Definition) -> str:
    name = _link(link.to(definition.key, definition.anchor), f"<code>{definition.name}</code>")
    where = f'<span class="rb-place">{definition.kind}, {definition.file}</span>'
    users = _unique(
        _user(woven, link, key) for key in woven.identifiers.used_in.get(definition, [])
    )
    uses = ", ".join(users[:_MOST_USERS])
    if len(users) > _MOST_USERS:
        uses += f" and {len(users) - _MOST_USERS} more"
    return f"<li>{name} {where}{f'<br>used in {uses}' if uses else ''}</li>"


def _user(woven: Woven, link: Linker, key: str) -> str:
    piece = woven.piece(key)
    title = escape(woven.title(piece))
    return _link(link.to(key), title if piece.is_root else f"⟨{title}⟩")


def _unique(texts: Iterable[str]) -> list[str]:
    return list(dict.fromkeys(texts))


def _link(address: str | None, html: str) -> str:
    return f'<a href="{address}">{html}</a>' if address else html
