"""`{output}`: what a program prints, as it stands on the page, compared with what it prints now.

The page breaks long lines by hand, so that spaces count as one. Numbers may differ a little: the
mathematics of another processor rounds otherwise.
"""

from __future__ import annotations

import hashlib
import math
import re
import shlex
import subprocess
from itertools import zip_longest
from pathlib import Path
from typing import ClassVar

from docutils import nodes
from docutils.parsers.rst import directives
from sphinx.application import Sphinx

from ..errors import BadInput
from ..expected.programs import reference_program
from ..files import locked, write_text
from .directives import BookDirective
from .figure_spec import code_key

_PART = re.compile(r"-?\d+(?:\.\d+)?(?:e[+-]?\d+)?|[^\W\d]\w*|\S")
_TOLERANCE = 1e-3
_NEAR = 40  # characters of context in a message


class OutputDirective(BookDirective):
    """`:::{output}` with `:run: raybook ...; raybook ...`, in the folder `:in:` of the checkout."""

    has_content = True
    option_spec: ClassVar = {
        "run": directives.unchanged_required,
        "in": directives.unchanged,
    }

    def run(self) -> list[nodes.Node]:
        shown = "\n".join(self.content)
        root, cache = Path(self.config.book_root), Path(self.config.book_figures)
        if "run" not in self.options:
            return self.fault("output: no :run:")
        try:
            printed = printed_by(root, cache, self.options["run"], self.options.get("in", "."))
        except BadInput as fault:
            return self.fault(f"output: {fault}")
        if changed := difference(shown, printed):
            return self.fault(f"output of {self.options['run']}: {changed}")
        return [nodes.literal_block(shown, shown, language="text")]


def printed_by(root: Path, cache: Path, commands: str, folder: str) -> str:
    """What the commands print, one after the other; from the cache if nothing has changed."""
    place = root / folder
    scenes = [place / word for word in commands.replace(";", " ").split() if word.endswith(".json")]
    key = hashlib.sha256("\0".join([code_key(root), commands, folder]).encode())
    for file in [*scenes, *(sorted(place.iterdir()) if place != root else [])]:
        if not file.is_file():
            raise BadInput(f"no file {file.relative_to(root)}")
        key.update(file.read_bytes())
    kept = cache / f"output-{key.hexdigest()[:20]}" / "printed.txt"
    with locked(kept.with_name(".lock")):
        if not kept.is_file():
            write_text(kept, "".join(_run(root, place, one) for one in commands.split(";")))
    return kept.read_text(encoding="utf-8")


def _run(root: Path, place: Path, command: str) -> str:
    name, *words = shlex.split(command)
    if name.rpartition("/")[2] != "raybook":
        raise BadInput(f"{name}: only raybook's output is shown")
    done = subprocess.run(
        [str(reference_program(root)), *words], cwd=place, check=False, text=True,
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=60,
    )  # fmt: skip
    return done.stdout


def difference(shown: str, printed: str) -> str:
    """Where they differ, in words; empty if they are the same."""
    pairs = zip_longest(_PART.finditer(shown), _PART.finditer(printed))
    for ours, theirs in pairs:
        if ours is None or theirs is None or not _same(ours[0], theirs[0]):
            there, here = (_from(text, match) for text, match in ((printed, theirs), (shown, ours)))
            return f"the program prints {there!r}, the page has {here!r}"
    return ""


def _same(ours: str, theirs: str) -> bool:
    if ours == theirs:
        return True
    if "." not in ours + theirs:
        return False
    try:
        a, b = float(ours), float(theirs)
    except ValueError:
        return False
    return math.isclose(a, b, rel_tol=_TOLERANCE, abs_tol=_TOLERANCE)


def _from(text: str, match: re.Match[str] | None) -> str:
    return text[match.start() : match.start() + _NEAR] if match else "nothing more"


def setup(app: Sphinx) -> None:
    """Register the directive."""
    app.add_directive("output", OutputDirective)
