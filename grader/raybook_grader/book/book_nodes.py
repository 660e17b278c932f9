"""The doctree nodes that the weaver adds, and the state that it keeps with the application."""

from __future__ import annotations

from dataclasses import dataclass

from docutils import nodes
from sphinx.application import Sphinx

from ..literate.check import Assignment
from ..literate.pieces import Piece
from .editions import Edition, Reader
from .identifiers import Identifiers
from .places import Places, places_of


class code_box(nodes.General, nodes.Element):
    """A piece of the source; `key` names it. Its children are the caption."""


class search_text(nodes.Invisible, nodes.TextElement):
    """Words that the search finds and that stand on the page in another form."""


class code_link(nodes.Inline, nodes.TextElement):
    """A link to a piece (`key`) or, with `anchor`, to a line of it."""


class fragment_index(nodes.General, nodes.Element):
    """The list of all fragments."""


class identifier_index(nodes.General, nodes.Element):
    """The list of all identifiers."""


@dataclass(frozen=True)
class Woven:
    """What the book is woven from."""

    reader: Reader
    identifiers: Identifiers
    assignments: tuple[Assignment, ...]

    @property
    def for_students(self) -> bool:
        return self.reader.edition is Edition.STUDENT

    def piece(self, key: str) -> Piece:
        return self.reader.pieces[key]

    def title(self, piece: Piece) -> str:
        """A fragment's title; of a file, its name."""
        return piece.file if piece.is_root else self.reader.tree.title(piece)


def woven_of(app: Sphinx) -> Woven:
    woven: Woven = app.raybook_woven  # type: ignore[attr-defined]
    return woven


class Linker:
    """Addresses of pieces and names, as they are seen from one page."""

    def __init__(self, app: Sphinx, page: str) -> None:
        self._app, self._page = app, page
        self._places: Places = places_of(app.env)

    def to(self, key: str, anchor: str = "") -> str | None:
        """The address of a piece, or of an anchor in it; None if no page shows it."""
        page = self._places.page_of(key)
        if page is None:
            return None
        alone = page == self._page or self._app.builder.name == "singlehtml"
        return f"{'' if alone else self._page_to(page)}#{anchor or key}"

    def _page_to(self, page: str) -> str:
        return self._app.builder.get_relative_uri(self._page, page)
