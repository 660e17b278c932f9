"""Small things of typesetting that a browser does not do by itself."""

from __future__ import annotations

from docutils import nodes
from sphinx.transforms.post_transforms import SphinxPostTransform

_STAYS = tuple(",.;:!?)")
_WORD_JOINER = "\u2060"


class KeepPunctuation(SphinxPostTransform):
    """No line begins with the comma that belongs to the formula before it."""

    default_priority = 400
    formats = ("html",)

    def run(self, **_: object) -> None:
        """Join each formula in the text with what follows it."""
        for formula in list(self.document.findall(nodes.math)):
            after = formula.next_node(descend=False, siblings=True)
            if isinstance(after, nodes.Text) and after.startswith(_STAYS):
                after.parent.replace(after, nodes.Text(_WORD_JOINER + after))
