"""TeX to HTML while the book is made: pages need no script for their mathematics.

One node process sets every formula. TeX that it does not understand is a warning with a place,
and so fails the build.
"""

from __future__ import annotations

import json
import re
import shutil
import subprocess
from functools import cached_property
from importlib.resources import files
from pathlib import Path

from docutils import nodes
from sphinx.application import Sphinx
from sphinx.util import logging
from sphinx.util.math import get_node_equation_number
from sphinx.writers.html5 import HTML5Translator

_log = logging.getLogger(__name__)
_OTHER_FONTS = re.compile(r',url\([^)]*\.(?:woff|ttf)\) format\("[^"]*"\)')


class Katex:
    """A node process that is started with the first formula and ends with this one."""

    def __init__(self, folder: Path) -> None:
        """`folder` holds node_modules/katex."""
        self._folder = folder
        self._set: dict[tuple[str, bool], dict[str, str]] = {}

    def set(self, tex: str, display: bool) -> str:
        """The formula as HTML and MathML; raises ValueError for bad TeX."""
        answer = self._set.get((tex, display)) or self._ask(tex, display)
        self._set[tex, display] = answer
        if "error" in answer:
            raise ValueError(answer["error"])
        return answer["html"]

    def _ask(self, tex: str, display: bool) -> dict[str, str]:
        ask, tell = self._process.stdin, self._process.stdout
        assert ask and tell
        ask.write(json.dumps({"tex": tex, "display": display}) + "\n")
        ask.flush()
        answer: dict[str, str] = json.loads(tell.readline())
        return answer

    @cached_property
    def _process(self) -> subprocess.Popen[str]:
        script = files(__package__ or "").joinpath("static", "katex_pipe.mjs")
        return subprocess.Popen(
            ["node", str(script), str(self._folder)],
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, encoding="utf-8",
        )  # fmt: skip


def copy_assets(modules: Path, static: Path) -> None:
    """KaTeX's style sheet and the fonts that it names, into `static`/katex."""
    dist, out = modules / "node_modules" / "katex" / "dist", static / "katex"
    shutil.rmtree(out, ignore_errors=True)
    (out / "fonts").mkdir(parents=True)
    css = (dist / "katex.min.css").read_text(encoding="utf-8")
    (out / "katex.min.css").write_text(_OTHER_FONTS.sub("", css), encoding="utf-8")
    for font in sorted((dist / "fonts").glob("*.woff2")):
        shutil.copyfile(font, out / "fonts" / font.name)


def inline_math(writer: HTML5Translator, node: nodes.math) -> None:
    writer.body.append(f'<span class="math">{_html(writer, node, node.astext(), False)}</span>')
    raise nodes.SkipNode


def display_math(writer: HTML5Translator, node: nodes.math_block) -> None:
    number = ""
    if node["number"]:
        number = f'<span class="eqno">({get_node_equation_number(writer, node)})</span>'
    tex = _html(writer, node, _aligned(node.astext()), True)
    # The equation's id stands on a target before it.
    writer.body.append(f'<div class="math"><div class="math-body">{tex}</div>{number}</div>')
    raise nodes.SkipNode


def _aligned(tex: str) -> str:
    """Lines of a formula are aligned, if it doesn't say how it is laid out."""
    if r"\\" in tex and r"\begin{" not in tex:
        return rf"\begin{{aligned}}{tex}\end{{aligned}}"
    return tex


def _html(writer: HTML5Translator, node: nodes.Element, tex: str, display: bool) -> str:
    try:
        html: str = katex_of(writer.builder.app).set(tex, display)
    except ValueError as fault:
        _log.warning("TeX: %s in %r", fault, tex, location=node, type="katex")
        return ""
    return html


def katex_of(app: Sphinx) -> Katex:
    """The process that the application sets its formulas with."""
    katex: Katex = app.raybook_katex  # type: ignore[attr-defined]
    return katex


def setup(app: Sphinx) -> None:
    """Make KaTeX the renderer of all math."""
    app.add_html_math_renderer("raybook", (inline_math, None), (display_math, None))
    app.add_css_file("katex/katex.min.css", priority=300)
