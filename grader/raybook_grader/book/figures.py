"""`{render}`: a figure that the renderer draws while the book is made."""

from __future__ import annotations

from pathlib import Path
from typing import ClassVar

from docutils import nodes
from docutils.parsers.rst import directives
from sphinx.application import Sphinx
from sphinx.environment import BuildEnvironment
from sphinx.util import logging

from ..errors import BadInput
from ..files import locked
from . import figure_nodes
from .directives import BookDirective
from .editions import Edition
from .figure_nodes import address_of, labelled_picture, picture_row, render_figure
from .figure_spec import FigureSpec, Picture
from .manifest import Entry, differences, read_manifest, write_manifest
from .rendering import Drawn, draw

_log = logging.getLogger(__name__)


def _names(text: str) -> frozenset[str]:
    return frozenset(name.strip() for name in text.split(",") if name.strip())


class RenderDirective(BookDirective):
    """`:::{render} name` with `:scene:`, `:args:`, `:stub:`, `:mistake:`, `:alt:`, `:width:`."""

    required_arguments = 1
    has_content = True
    option_spec: ClassVar = {
        "scene": directives.unchanged_required,
        "args": directives.unchanged,
        "stub": _names,
        "mistake": directives.unchanged_required,
        "alt": directives.unchanged_required,
        "width": directives.unchanged_required,
    }

    def run(self) -> list[nodes.Node]:
        name = self.arguments[0].removeprefix("fig-")
        if missing := [key for key in ("scene", "alt") if not self.options.get(key)]:
            return self.fault(f"figure {name}: no :{missing[0]}:")
        if not self.content:
            return self.fault(f"figure {name}: no caption")
        spec = FigureSpec(name, self.options["scene"], self.options.get("args", "").strip(),
                          self.options.get("stub", frozenset()),
                          self.options.get("mistake", ""))  # fmt: skip
        try:
            drawn = [(p, self._drawn(spec, p)) for p in spec.pictures()]
        except BadInput as fault:
            return self.fault(f"figure {name}: {fault}")
        return [self._figure(spec, drawn)]

    def _drawn(self, spec: FigureSpec, picture: Picture) -> Drawn:
        root, cache = Path(self.config.book_root), Path(self.config.book_figures)
        drawn = draw(root, cache, spec, picture)
        entries = _entries(self.env)
        name = f"{spec.name}/{picture.kind}"
        entry = Entry(drawn.pixels, drawn.means)
        if entries.setdefault(name, entry) != entry:
            raise BadInput("another figure has the same name")
        return drawn

    def _figure(self, spec: FigureSpec, drawn: list[tuple[Picture, Drawn]]) -> nodes.Node:
        kind = drawn[0][0].kind
        figure = render_figure("", scene=spec.scene, args=spec.args, kind=kind)
        row = picture_row("", width=self.options.get("width", ""))
        row += [self._labelled(picture, file) for picture, file in drawn]
        figure += row
        figure += self._caption(spec)
        figure["names"] += [f"fig-{spec.name}"]
        self.state.document.note_explicit_target(figure, figure)
        return figure

    def _labelled(self, picture: Picture, drawn: Drawn) -> nodes.Element:
        labelled = labelled_picture("", kind=picture.kind, label=picture.label)
        alt = self.options["alt"]
        words = f"{alt} ({picture.label})" if picture.label else alt
        image = nodes.image(uri=address_of(self.env, drawn.file), alt=words)
        labelled += image
        return labelled

    def _caption(self, spec: FigureSpec) -> list[nodes.Node]:
        """The first paragraph is the caption; what follows, and the command, the legend."""
        words = self.parsed(nodes.container())
        first, *others = words.children
        caption = nodes.caption("", "", *first.children)
        legend = nodes.legend("", *others)
        command = nodes.paragraph(classes=["rb-command"])
        command += nodes.literal("", spec.command)
        legend += command
        return [caption, legend]


def _entries(environment: BuildEnvironment) -> dict[str, Entry]:
    if not hasattr(environment, "raybook_figures"):
        environment.raybook_figures = {}  # type: ignore[attr-defined]
    entries: dict[str, Entry] = environment.raybook_figures  # type: ignore[attr-defined]
    return entries


def check(app: Sphinx, environment: BuildEnvironment) -> None:
    """Compare what was drawn with the manifest, or accept it."""
    if not app.config.book_manifest:
        return
    file = Path(app.config.book_manifest)
    with locked(Path(app.config.book_figures) / ".manifest.lock"):
        messages = _compare(app, file, _entries(environment))
    for message in messages:
        if app.config.book_draft:
            _log.info("%s", message)
        else:
            how = "look at it, then accept it with `make book ACCEPT=1`"
            _log.warning("%s: %s", message, how, type="book", subtype="figure")


def _compare(app: Sphinx, file: Path, drawn: dict[str, Entry]) -> list[str]:
    """What is not as the manifest says; nothing once it is accepted."""
    whole = app.config.book_edition == Edition.INSTRUCTOR
    known = read_manifest(file)
    messages = differences(known, drawn, whole)
    if app.config.book_accept and messages:
        write_manifest(file, drawn if whole else {**known, **drawn})
        return []
    return messages


def setup(app: Sphinx) -> None:
    """Register the directive."""
    figure_nodes.setup(app)
    app.add_directive("render", RenderDirective)
    app.connect("env-check-consistency", check)
