"""A piece of the source as HTML: a title bar, numbered lines, and where it belongs."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape

from ..literate.pieces import Line, Piece
from .book_nodes import Linker, Woven
from .editions import BookItem, BookLine
from .highlight import highlight
from .identifiers import Definition

_FEW = 6
"""Places that a name is used in; of more, the list is folded."""


class CodeBox:
    """One piece on one page."""

    def __init__(self, woven: Woven, link: Linker, key: str) -> None:
        self._woven, self._link, self._key = woven, link, key
        self._piece = woven.piece(key)
        self._items = woven.reader.items(self._piece)
        self._indent = _common_indent(self._text_of(item) for item in self._items)

    def head(self) -> str:
        """The figure's beginning and its title bar."""
        piece, woven = self._piece, self._woven
        first, last = woven.reader.span(piece)
        title = f"<code>{piece.file}</code>" if piece.is_root else _angles(escape(self._title()))
        root = " data-root" if piece.is_root else ""
        place = f"{first}–{last}" if piece.is_root else f"{piece.file}:{first}–{last}"
        return (
            f'<figure class="rb-code" id="{self._key}" data-file="{piece.file}"'
            f' data-indent="{self._indent}"{root}>'
            f'<figcaption><span class="rb-title">{title}</span>{self._siblings()}'
            f'<span class="rb-place">{place}</span>'
            f'<a class="headerlink" href="#{self._key}" title="Link to this code"'
            f' aria-label="Link to this code">¶</a></figcaption>'
        )

    def body(self) -> str:
        """The lines, the stub beside them, what refers to them, and the figure's end."""
        lines = [self._text_of(item)[self._indent :] for item in self._items]
        marked = highlight(lines, self._address)
        rows = (self._row(item, html) for item, html in zip(self._items, marked, strict=True))
        return f"<pre>{''.join(rows)}</pre>{self._stub()}{self._foot()}</figure>"

    # The title bar.

    def _title(self) -> str:
        more = "+" if self._piece.continuation else ""
        return self._woven.title(self._piece) + more

    def _siblings(self) -> str:
        """Links to the fragment's other pieces, if it has any."""
        if self._piece.is_root:
            return ""
        pieces = self._woven.reader.tree.fragments[self._piece.slug].pieces
        keys = [self._woven.reader.key(p) for p in pieces if p is not self._piece]
        links = [self._anchor(key, "another piece", "rb-ref") for key in keys]
        return f'<span class="rb-more">{", ".join(links)}</span>' if links else ""

    # The lines.

    def _text_of(self, item: BookItem) -> str:
        """A line's text; a nested fragment is a comment as far as colours go."""
        if isinstance(item, BookLine):
            return item.text
        marker = self._woven.reader.tree.files[item.file].text[item.first - 1]
        return f"{marker[: len(marker) - len(marker.lstrip())]}//"

    def _row(self, item: BookItem, html: str) -> str:
        if isinstance(item, Piece):
            return self._nested(item)
        names = self._woven.identifiers.at.get((self._piece.file, item.origin), [])
        places = "".join(f'<span id="{d.anchor}"></span>' for d in names if d.key == self._key)
        return f'<span class="rb-line" data-n="{item.number:>5}">{places}{html}\n</span>'

    def _nested(self, piece: Piece) -> str:
        """A fragment in place of its lines; in the student's file its title is a comment."""
        key = self._woven.reader.key(piece)
        text = self._text_of(piece)[self._indent : -2]
        comment = piece.title and not piece.is_top_level and self._woven.for_students
        first, last = self._woven.reader.span(piece)
        link = self._anchor(key, self._woven.title(piece), "rb-ref")
        return (
            f'<span class="rb-line rb-nested" data-n="{first:>5}" data-nested="{key}"'
            f"{' data-comment' if comment else ''}>{text}{_angles(link)}"
            f'<span class="rb-lines" data-text="{first}–{last}"></span>\n</span>'
        )

    def _stub(self) -> str:
        stub: Sequence[Line] = self._woven.reader.stub(self._piece)
        if not stub:
            return ""
        marked = highlight([line.text[self._indent :] for line in stub], self._address)
        rows = (
            f'<span class="rb-line" data-n="{line.number:>5}">{html}\n</span>'
            for line, html in zip(stub, marked, strict=True)
        )
        return (
            '<details class="rb-stub"><summary>What students find here</summary>'
            f"<pre>{''.join(rows)}</pre></details>"
        )

    # What refers to it.

    def _foot(self) -> str:
        rows = [self._used_in(), *map(self._uses_of, self._definitions())]
        rows = [row for row in rows if row]
        return f'<div class="rb-foot">{"".join(rows)}</div>' if rows else ""

    def _definitions(self) -> list[Definition]:
        """Those that other files may use, too; what uses a helper of this file is near."""
        defined = self._woven.identifiers.defined_in(self._key)
        return [definition for definition in defined if not definition.of_file_only]

    def _used_in(self) -> str:
        """The piece around it; a file has none."""
        around = self._piece.parent
        return f"<p>Used in {self._reference(self._woven.reader.key(around))}</p>" if around else ""

    def _uses_of(self, definition: Definition) -> str:
        users = self._woven.identifiers.used_in.get(definition, [])
        links = ", ".join(map(self._reference, users))
        name = f"<code>{definition.name}</code> is used in"
        if len(users) <= _FEW:
            return f"<p>{name} {links}</p>" if users else ""
        return f"<details><summary>{name} {len(users)} places</summary><p>{links}</p></details>"

    # Links.

    def _address(self, name: str) -> str | None:
        definition = self._woven.identifiers.find(name, self._piece.file)
        if definition is None or definition.key == self._key:
            return None
        return self._link.to(definition.key, definition.anchor)

    def _reference(self, key: str) -> str:
        piece = self._woven.piece(key)
        link = self._anchor(key, self._woven.title(piece), "rb-ref")
        return link if piece.is_root else _angles(link)

    def _anchor(self, key: str, text: str, name: str) -> str:
        address = self._link.to(key)
        words = escape(text)
        return f'<a class="{name}" href="{address}">{words}</a>' if address else words


def _angles(html: str) -> str:
    return f'<span class="rb-angle">⟨{html}⟩</span>'


def _common_indent(texts: Iterable[str]) -> int:
    return min((len(t) - len(t.lstrip()) for t in texts if t.strip()), default=0)
