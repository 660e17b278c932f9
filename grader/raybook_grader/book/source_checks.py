"""Checks of the source that the book rests on: the student export, and every stub alone.

That a stub fails its own assignment's tests and no other's is left to `make test`.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from ..errors import BadInput
from ..expected.programs import reference_program
from ..literate.equivalence import preprocessor_differences, unifdef_difference
from ..literate.export import export
from ..literate.tree import SourceTree
from .figure_spec import FigureSpec
from .rendering import render_pixels

_SCENES = ("scenes/cornell-box.json", "scenes/textures.json")


def source_faults(root: Path, tree: SourceTree) -> list[str]:
    """What two other tools export otherwise, and the stubs with which nothing can be drawn."""
    return [*_export_faults(tree), *_stub_faults(root, tree)]


def _export_faults(tree: SourceTree) -> Iterator[str]:
    for source in tree.files.values():
        if source.regions and (difference := unifdef_difference(source, export(source))):
            yield f"student export: {difference}"
    for difference in preprocessor_differences(tree):
        yield f"student export: {difference}"


def _stub_faults(root: Path, tree: SourceTree) -> Iterator[str]:
    """Each exercise alone as its stub: compiled with every warning an error, and run."""
    for name in tree.todos:
        try:
            program = reference_program(root, frozenset({name}))
            for scene in _SCENES:
                render_pixels(root, FigureSpec(name, scene, "--resolution 32x32 --spp 1"), program)
        except BadInput as fault:
            yield f"stub {name}: {fault}"
