"""The typefaces of the pages: what they need of the packages in build/node."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

_FACES = {
    "source-serif-4": ("index.css", "wght-italic.css"),
    "source-sans-3": ("index.css", "wght-italic.css"),
    "source-code-pro": ("index.css",),
}
_SUBSETS = ("latin", "latin-ext", "greek")
_FACE = re.compile(r"@font-face\s*{[^}]*}")
_FILE = re.compile(r"url\(\./files/([^)]+-wght-(?:normal|italic)\.woff2)\)")


def copy_fonts(node: Path, static: Path) -> None:
    """`static`/fonts with the font files and a style sheet that names them."""
    out = static / "fonts"
    shutil.rmtree(out, ignore_errors=True)
    out.mkdir(parents=True)
    rules: list[str] = []
    for family, sheets in _FACES.items():
        package = node / "node_modules" / "@fontsource-variable" / family
        for sheet in sheets:
            rules += _copied(package, sheet, family, out)
    (out / "fonts.css").write_text("\n".join(rules) + "\n", encoding="utf-8")


def _copied(package: Path, sheet: str, family: str, out: Path) -> list[str]:
    """The rules of a style sheet for the subsets that we need, their files copied."""
    wanted = re.compile(rf"{family}-(?:{'|'.join(_SUBSETS)})-wght-")
    rules = []
    for rule in _FACE.findall((package / sheet).read_text(encoding="utf-8")):
        file = _FILE.search(rule)
        if file and wanted.match(file[1]):
            shutil.copyfile(package / "files" / file[1], out / file[1])
            rules.append(rule.replace("./files/", ""))
    return rules
