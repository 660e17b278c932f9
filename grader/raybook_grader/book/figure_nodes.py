"""The doctree nodes of rendered figures, and how they look in HTML.

A figure has a stable id and says in data- attributes which scene and options made it, so that it
can later be drawn in the page.
"""

from __future__ import annotations

import hashlib
import os
from html import escape
from pathlib import Path

from docutils import nodes
from sphinx.application import Sphinx
from sphinx.environment import BuildEnvironment
from sphinx.writers.html5 import HTML5Translator

from ..files import locked, write_bytes


class render_figure(nodes.figure):
    """A numbered figure: `pictures`, a caption, a legend."""


class picture_row(nodes.General, nodes.Element):
    """Pictures side by side."""


class labelled_picture(nodes.General, nodes.Element):
    """An image and, in `label`, the few words beneath it."""


def place_picture(environment: BuildEnvironment, name: str, data: bytes) -> str:
    """Put a picture where the build finds it; its address for an image node.

    It is never written twice: the other edition may have read its pages by then, and would take
    the page for one that has changed.
    """
    of_this_content = hashlib.sha256(data).hexdigest()[:20]
    file = Path(environment.config.book_figures, of_this_content, name)
    with locked(file.parent / ".lock"):
        if not file.is_file():
            write_bytes(file, data)
    return address_of(environment, file)


def address_of(environment: BuildEnvironment, file: Path) -> str:
    """What an image node calls a file: its path from the top of docs/."""
    return "/" + os.path.relpath(file, environment.srcdir)


def visit_figure(writer: HTML5Translator, node: render_figure) -> None:
    data = {f"data-{key}": node[key] for key in ("scene", "args", "kind")}
    writer.body.append(writer.starttag(node, "figure", CLASS="rb-figure", **data))


def depart_figure(writer: HTML5Translator, node: render_figure) -> None:
    writer.body.append("</figure>\n")


def visit_row(writer: HTML5Translator, node: picture_row) -> None:
    style = f' style="--rb-width: {escape(node["width"])}"' if node.get("width") else ""
    writer.body.append(f'<div class="rb-pictures" data-count="{len(node.children)}"{style}>')


def depart_row(writer: HTML5Translator, node: picture_row) -> None:
    writer.body.append("</div>")


def visit_picture(writer: HTML5Translator, node: labelled_picture) -> None:
    writer.body.append(f'<div class="rb-picture" data-picture="{node["kind"]}">')


def depart_picture(writer: HTML5Translator, node: labelled_picture) -> None:
    label = f'<p class="rb-label">{escape(node["label"])}</p>' if node["label"] else ""
    writer.body.append(f"{label}</div>")


def caption_of(node: nodes.Node) -> str:
    """What a list of figures, or a reference by number, calls it."""
    assert isinstance(node, nodes.Element)
    for child in node.children:
        if isinstance(child, nodes.caption):
            return child.astext()
    return ""


def setup(app: Sphinx) -> None:
    """Register the nodes."""
    app.add_enumerable_node(render_figure, "figure", caption_of, html=(visit_figure, depart_figure))
    app.add_node(picture_row, html=(visit_row, depart_row))
    app.add_node(labelled_picture, html=(visit_picture, depart_picture))
