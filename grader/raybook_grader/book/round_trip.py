"""Check: the C that is rebuilt from the pages is the reader's own, and renders the same image."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import zip_longest
from pathlib import Path

from ..errors import BadInput
from ..expected.programs import reference_program, variant_program
from .editions import Edition, Reader
from .figure_spec import FigureSpec
from .rendering import render_pixels
from .untangle import untangle

_SCENE = "scenes/cornell-box.json"
_ARGUMENTS = "--resolution 96x96 --spp 4"


def text_faults(site: Path, reader: Reader) -> list[str]:
    """Where the rebuilt files differ from the reader's; files that no page shows are no fault
    here (the check of coverage tells them)."""
    try:
        rebuilt = untangle(site)
    except BadInput as fault:
        return [f"round trip: {fault}"]
    return [
        f"round trip: {difference}"
        for file, text in rebuilt.items()
        if (difference := _first_difference(file, reader.text(file), text))
    ]


def render_faults(root: Path, site: Path, reader: Reader) -> list[str]:
    """Compile what is rebuilt in place of the checkout's files and render a scene with both."""
    rebuilt = {name: text.encode() for name, text in untangle(site).items()}
    stubs = frozenset(reader.tree.todos) if reader.edition is Edition.STUDENT else frozenset()
    try:
        ours = _pixels(root, reference_program(root, stubs))
        theirs = _pixels(root, variant_program(root, _sources(rebuilt)))
    except BadInput as fault:
        return [f"round trip: {fault}"]
    return [] if ours == theirs else ["round trip: the rebuilt program renders another picture"]


def _sources(files: Mapping[str, bytes]) -> dict[str, bytes]:
    """Headers are compared to the letter; what is compiled is a .c file."""
    return {name: text for name, text in files.items() if name.endswith(".c")}


def _pixels(root: Path, program: Path) -> bytes:
    return render_pixels(root, FigureSpec("round-trip", _SCENE, _ARGUMENTS), program).tobytes()


def _first_difference(file: str, expected: str, found: str) -> str | None:
    pairs = zip_longest(expected.split("\n"), found.split("\n"))
    for number, (want, have) in enumerate(pairs, 1):
        if want != have:
            return f"{file}:{number}: the book has {have!r}, the file {want!r}"
    return None
