"""`` {frag}`slug` `` and `` {id}`name` ``: links to a fragment, and to where a name is defined."""

from __future__ import annotations

from docutils import nodes
from docutils.nodes import Node, system_message
from sphinx.util.docutils import SphinxRole

from .book_nodes import code_link, woven_of


class FragmentRole(SphinxRole):
    """A fragment by its slug, or a file by its name; `src/a.c` is shown as itself."""

    def run(self) -> tuple[list[Node], list[system_message]]:
        woven = woven_of(self.env.app)
        fragment = woven.reader.tree.fragments.get(self.text)
        if fragment:
            key = woven.reader.key(fragment.pieces[0])
            words: Node = nodes.inline("", f"⟨{fragment.title}⟩", classes=["rb-title"])
        elif file := woven.reader.files.get(self.text):
            key, words = woven.reader.key(file.root), nodes.literal("", self.text)
        else:
            return _fault(self, f"there is no fragment and no module {self.text}")
        return [code_link("", "", words, key=key)], []


class IdentifierRole(SphinxRole):
    """A function, type, macro ... by its name."""

    def run(self) -> tuple[list[Node], list[system_message]]:
        woven = woven_of(self.env.app)
        definition = woven.identifiers.find(self.text)
        if definition is None and woven.for_students:
            # A helper of a solution: its name is no secret, and the other edition checks it.
            return [nodes.literal("", self.text)], []
        if definition is None:
            return _fault(self, f"no module defines {self.text}")
        words = nodes.literal("", self.text)
        return [code_link("", "", words, key=definition.key, anchor=definition.anchor)], []


def _fault(role: SphinxRole, message: str) -> tuple[list[Node], list[system_message]]:
    return [nodes.literal("", role.text)], [
        role.inliner.reporter.warning(message, line=role.lineno)
    ]
