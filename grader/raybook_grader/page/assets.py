"""A page's own style and script, and the policy that lets nothing else in.

The policy (Content Security Policy Level 3, sections 6.6 and 6.7) refuses every request, and any
style or script whose hash it does not name: so a page that is opened from a file cannot call
home, whatever a submission might smuggle into it.
"""

from __future__ import annotations

import base64
import hashlib
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

from markupsafe import Markup

File = tuple[str, str]
"""A package and a file in its `templates` folder."""

_PAGE = __package__ or ""
_STYLES: tuple[File, ...] = ((_PAGE, "base.css"),)
_SCRIPTS: tuple[File, ...] = ((_PAGE, "theme.js"), (_PAGE, "printing.js"))


@dataclass(frozen=True)
class Assets:
    """The text of the one `<style>` and the one `<script>` of a page, and their policy."""

    style: Markup
    script: Markup
    policy: str


@cache
def assets(styles: Sequence[File] = (), scripts: Sequence[File] = ()) -> Assets:
    """The shared style and script with those files of a page's own behind them."""
    style = "\n" + _colours() + "".join(_read(file) for file in (*_STYLES, *styles))
    script = "\n" + "".join(_read(file) for file in (*_SCRIPTS, *scripts))
    policy = (
        f"default-src 'none'; style-src {_hash(style)}; script-src {_hash(script)}; "
        "img-src data:; base-uri 'none'; form-action 'none'"
    )
    return Assets(Markup(style), Markup(script), policy)


def _colours() -> str:
    """Light unless the reader's system or the button says dark; paper is light."""
    light, dark = (_read((_PAGE, f"{name}.css")) for name in ("light", "dark"))
    return (
        f":root {{\n{light}}}\n"
        f"@media screen and (prefers-color-scheme: dark) {{\n"
        f":root:not([data-theme=light]) {{\n{dark}}}\n}}\n"
        f"@media screen {{\n:root[data-theme=dark] {{\n{dark}}}\n}}\n"
    )


def _read(file: File) -> str:
    package, name = file
    return files(package).joinpath("templates", name).read_text(encoding="utf-8")


def _hash(text: str) -> str:
    digest = hashlib.sha256(text.encode("utf-8")).digest()
    return f"'sha256-{base64.b64encode(digest).decode('ascii')}'"
