"""From the text of a report to HTML.

Beside plain Markdown a report may hold

    ![caption](scenes/cornell-box.json "--spp 16")     a scene, rendered now
    ```timings                                         a table; each line a scene and its options
    ```assignments                                     a table of what is done
"""

from __future__ import annotations

import base64
from collections.abc import Callable, Sequence
from html import escape
from importlib.resources import files
from pathlib import Path
from typing import Any

from markdown_it import MarkdownIt
from markdown_it.renderer import RendererHTML
from markdown_it.token import Token

from ..findings import Finding, State
from .renderings import NotDrawn, Renderer, numbers_of, split_order

_STATES = {State.DONE: "done", State.FAILING: "begun", State.TO_DO: "not begun"}
_HEADINGS = ("scene", "primitives", "tree built", "rendered", "samples/s", "boxes a ray",
             "primitives a ray")  # fmt: skip


def page_html(text: str, renderer: Renderer, check: Callable[[], Sequence[Finding]]) -> str:
    """The whole page, self-contained but for pictures that the text itself takes from files."""
    markdown = MarkdownIt("commonmark", {"html": False}).enable(["table", "strikethrough"])
    plain_image, plain_fence = RendererHTML.image, RendererHTML.fence

    def image(self: RendererHTML, tokens: Sequence[Token], at: int, options: Any, env: Any) -> str:
        source = str(tokens[at].attrs.get("src", ""))
        if not source.endswith(".json"):
            return plain_image(self, tokens, at, options, env)
        return _figure(renderer, source, str(tokens[at].attrs.get("title", "")), tokens[at].content)

    def fence(self: RendererHTML, tokens: Sequence[Token], at: int, options: Any, env: Any) -> str:
        kind = tokens[at].info.strip()
        if kind == "timings":
            return _timings(renderer, tokens[at].content)
        if kind == "assignments":
            return _assignments(check())
        return plain_fence(self, tokens, at, options, env)

    markdown.add_render_rule("image", image)
    markdown.add_render_rule("fence", fence)
    style = files(__package__).joinpath("report.css").read_text(encoding="utf-8")
    title = next((line[2:] for line in text.splitlines() if line.startswith("# ")), "Report")
    return (
        f'<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        f"<title>{escape(title)}</title>\n<style>\n{style}</style>\n</head>\n<body>\n"
        f"{markdown.render(text)}</body>\n</html>\n"
    )


def _figure(renderer: Renderer, scene: str, options: str, caption: str) -> str:
    order = escape(f"{scene} {options}".strip())
    try:
        rendering = renderer.render(scene, options)
    except NotDrawn as reason:
        return _missing(str(reason))
    uri = "data:image/png;base64," + base64.b64encode(rendering.png).decode("ascii")
    return (
        f'<span class="figure"><img src="{uri}" alt="{escape(caption)}">'
        f'<span class="caption">{escape(caption)}</span>'
        f'<span class="order">{order}: {escape(numbers_of(rendering))}</span></span>'
    )


def _timings(renderer: Renderer, orders: str) -> str:
    rows: list[str] = []
    for line in filter(str.strip, orders.splitlines()):
        scene, options = split_order(line)
        try:
            stats = renderer.render(scene, options)
        except NotDrawn as reason:
            rows.append(f'<tr><td colspan="{len(_HEADINGS)}">{_missing(str(reason))}</td></tr>')
            continue
        s, rays = stats.stats, max(1, stats.rays)
        cells = [
            f"{s['primitives']:,}",
            _duration(s["build_seconds"]),
            f"{stats.seconds:.2f} s",
            f"{s['samples_per_second'] / 1e6:.2f} million",
            f"{s['boxes_tested'] / rays:.1f}",
            f"{s['primitives_tested'] / rays:.1f}",
        ]
        name = escape(Path(scene).stem) + (f"<br><small>{escape(options)}</small>" * bool(options))
        rows.append(_row("td", [name, *cells]))
    return f'<table class="numbers">\n{_row("th", _HEADINGS)}\n' + "\n".join(rows) + "\n</table>\n"


def _duration(seconds: float) -> str:
    return f"{seconds:.2f} s" if seconds >= 1 else f"{1e3 * seconds:.3g} ms"


def _assignments(findings: Sequence[Finding]) -> str:
    rows = [
        _row("td", [escape(f.assignment.name), _STATES[f.state], escape(f.headline)])
        for f in findings
    ]
    heading = _row("th", ["assignment", "state", "what make check says"])
    return f"<table>\n{heading}\n" + "\n".join(rows) + "\n</table>\n"


def _row(kind: str, cells: Sequence[str]) -> str:
    return "<tr>" + "".join(f"<{kind}>{cell}</{kind}>" for cell in cells) + "</tr>"


def _missing(reason: str) -> str:
    return f'<span class="missing">{escape(reason)}</span>'
