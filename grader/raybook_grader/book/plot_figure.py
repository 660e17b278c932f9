"""`{plot}`: a plot of data that is measured while the book is made."""

from __future__ import annotations

from pathlib import Path
from typing import ClassVar

from docutils import nodes
from docutils.parsers.rst import directives
from sphinx.application import Sphinx

from ..errors import BadInput
from .directives import BookDirective
from .figure_nodes import address_of
from .plots.table import plot_file


class PlotDirective(BookDirective):
    """`:::{plot} name`: a numbered figure, "fig-name"; `:alt:` and a caption are required."""

    required_arguments = 1
    has_content = True
    option_spec: ClassVar = {"alt": directives.unchanged_required}

    def run(self) -> list[nodes.Node]:
        name = self.arguments[0]
        if not self.options.get("alt") or not self.content:
            return self.fault(f"plot {name}: no {'caption' if self.options else ':alt:'}")
        root, cache = Path(self.config.book_root), Path(self.config.book_figures)
        try:
            file = plot_file(root, cache, name)
        except BadInput as fault:
            return self.fault(f"plot {name}: {fault}")
        image = nodes.image(uri=address_of(self.env, file), alt=self.options["alt"], width="100%")
        figure = nodes.figure("", image, names=[f"fig-{name}"])
        first, *others = self.parsed(nodes.container()).children
        figure += nodes.caption("", "", *first.children)
        if others:
            figure += nodes.legend("", *others)
        self.state.document.note_explicit_target(figure, figure)
        return [figure]


def setup(app: Sphinx) -> None:
    """Register the directive."""
    app.add_directive("plot", PlotDirective)
