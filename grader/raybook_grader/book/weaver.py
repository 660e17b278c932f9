"""The Sphinx extension that weaves source and chapters.

Configured by `book_edition` ("student" or "instructor"), `book_draft` (what is not shown yet is
no fault) and `book_root` (the checkout).
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from docutils import nodes
from sphinx.application import Sphinx
from sphinx.environment import BuildEnvironment
from sphinx.util import logging
from sphinx.writers.html5 import HTML5Translator

from ..literate.check import load_sound
from . import bibliography, charts, directives, figures, katex, outputs, plot_figure, roles
from .assets import copy_fonts
from .book_nodes import (
    Linker,
    Woven,
    code_box,
    code_link,
    fragment_index,
    identifier_index,
    search_text,
    woven_of,
)
from .code_html import CodeBox
from .coverage import coverage_faults
from .editions import Edition, Reader
from .identifiers import Identifiers
from .indices import fragment_list, identifier_list
from .places import places_of
from .typography import KeepPunctuation

_log = logging.getLogger(__name__)
_STATIC = Path(__file__).parent / "static"


def load(app: Sphinx) -> None:
    """Read the checkout; it must be sound."""
    tree, assignments = load_sound(Path(app.config.book_root))
    reader = Reader(tree, Edition(app.config.book_edition))
    app.raybook_woven = Woven(  # type: ignore[attr-defined]
        reader, Identifiers(reader), tuple(assignments)
    )
    app.raybook_katex = katex.Katex(Path(app.config.book_node))  # type: ignore[attr-defined]


def check(app: Sphinx, environment: BuildEnvironment) -> None:
    """Every line of every module once, every exercise once."""
    if app.config.book_draft:
        return
    for fault in coverage_faults(woven_of(app), places_of(environment)):
        _log.warning("%s", fault, type="book", subtype="coverage")


def resolve(app: Sphinx, tree: nodes.document, page: str) -> None:
    """Turn links to code into references, now that every page is known."""
    link = Linker(app, page)
    for node in list(tree.findall(code_link)):
        address = link.to(node["key"], node.get("anchor", ""))
        if address:
            node.replace_self(
                nodes.reference("", "", *node.children, refuri=address, internal=True)
            )
        else:
            node.replace_self(node.children)


def visit_code_box(writer: HTML5Translator, node: code_box) -> None:
    writer.body.append(_box(writer, node).head())


def depart_code_box(writer: HTML5Translator, node: code_box) -> None:
    writer.body.append(_box(writer, node).body())


def visit_search_text(writer: HTML5Translator, node: search_text) -> None:
    raise nodes.SkipNode


def visit_fragment_index(writer: HTML5Translator, node: fragment_index) -> None:
    app = writer.builder.app
    writer.body.append(fragment_list(woven_of(app), _linker(writer)))
    raise nodes.SkipNode


def visit_identifier_index(writer: HTML5Translator, node: identifier_index) -> None:
    app = writer.builder.app
    writer.body.append(identifier_list(woven_of(app), _linker(writer)))
    raise nodes.SkipNode


def _box(writer: HTML5Translator, node: code_box) -> CodeBox:
    return CodeBox(woven_of(writer.builder.app), _linker(writer), node["key"])


def _linker(writer: HTML5Translator) -> Linker:
    return Linker(writer.builder.app, writer.builder.current_docname)


def add_static_files(app: Sphinx) -> None:
    """Our style sheet, KaTeX and the fonts; the HTML builder copies what is in these folders."""
    made = Path(app.config.book_assets)
    katex.copy_assets(Path(app.config.book_node), made)
    copy_fonts(Path(app.config.book_node), made)
    app.config.html_static_path += [str(_STATIC / "site"), str(made)]


def setup(app: Sphinx) -> dict[str, Any]:
    """Register everything with Sphinx."""
    bibliography.register()
    for name, value in (("edition", "instructor"), ("draft", False), ("root", ".."),
                        ("node", "."), ("assets", "assets"), ("figures", "figures"),
                        ("manifest", ""), ("accept", False)):  # fmt: skip
        app.add_config_value(f"book_{name}", value, "env")
    app.connect("builder-inited", load, priority=400)
    app.connect("builder-inited", add_static_files, priority=450)
    app.connect("env-check-consistency", check)
    app.connect("doctree-resolved", resolve)
    app.add_node(code_box, html=(visit_code_box, depart_code_box))
    app.add_node(search_text, html=(visit_search_text, None))
    app.add_node(code_link)
    app.add_node(fragment_index, html=(visit_fragment_index, None))
    app.add_node(identifier_index, html=(visit_identifier_index, None))
    app.add_directive("fragment", directives.FragmentDirective)
    app.add_directive("source", directives.SourceDirective)
    app.add_directive("exercise", directives.ExerciseDirective)
    app.add_directive("solution", directives.SolutionDirective)
    app.add_directive("instructor", directives.InstructorDirective)
    app.add_directive("fragment-index", directives.FragmentIndexDirective)
    app.add_directive("identifier-index", directives.IdentifierIndexDirective)
    app.add_post_transform(KeepPunctuation)
    app.add_role("frag", roles.FragmentRole())
    app.add_role("id", roles.IdentifierRole())
    app.add_css_file("fonts/fonts.css", priority=300)
    app.add_css_file("book.css", priority=900)
    for part in (katex, figures, charts, outputs, plot_figure):
        part.setup(app)
    return {"parallel_read_safe": False, "parallel_write_safe": True}
