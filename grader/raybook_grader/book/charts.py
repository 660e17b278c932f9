"""`{chart}`: a plot of what `make bench` has measured."""

from __future__ import annotations

from pathlib import Path
from typing import ClassVar

from docutils import nodes
from docutils.parsers.rst import directives
from sphinx.application import Sphinx

from .directives import BookDirective
from .figure_nodes import place_picture


class ChartDirective(BookDirective):
    """`:::{chart} name`: build/bench/name.svg, if there is one."""

    required_arguments = 1
    has_content = True
    option_spec: ClassVar = {
        "alt": directives.unchanged_required,
        "width": directives.unchanged_required,
    }

    def run(self) -> list[nodes.Node]:
        name = self.arguments[0]
        folder = Path(self.config.book_root) / "build" / "bench"
        svg = folder / f"{name}.svg"
        if not (folder / "bench.json").is_file() or not svg.is_file():
            return self._no_measurement(name)
        picture = place_picture(self.env, f"chart-{name}.svg", svg.read_bytes())
        image = nodes.image(uri=picture, alt=self.options.get("alt", f"Chart: {name}"))
        if "width" in self.options:
            image["width"] = self.options["width"]
        figure = nodes.figure("", image, classes=["rb-chart"], ids=[f"chart-{name}"])
        caption = self.parsed(nodes.container())
        words = [c for child in caption.children for c in child.children]
        if words:
            figure += nodes.caption("", "", *words)
        return [figure]

    def _no_measurement(self, name: str) -> list[nodes.Node]:
        box = nodes.admonition(classes=["rb-unmeasured"], ids=[f"chart-{name}"])
        box += nodes.title("", "Not measured yet")
        words = nodes.paragraph("", "The chart of this place is made of measurements: run ")
        words += [nodes.literal("", "make bench"), nodes.Text(", then make the book again.")]
        box += words
        return [self.parsed(box)]


def setup(app: Sphinx) -> None:
    """Register the directive."""
    app.add_directive("chart", ChartDirective)
