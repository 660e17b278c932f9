"""Which plots there are, and the cache of them."""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path

from ...errors import BadInput
from ...files import locked, write_bytes
from ..figure_spec import FigureSpec, Picture, picture_key
from . import measured
from .drawing import error_svg, points_svg
from .points import sampler_points

_KINDS = ("independent", "stratified", "sobol")
_CUTS = ((16, 1), (8, 2), (4, 4), (2, 8), (1, 16))


@dataclass(frozen=True)
class Plot:
    """`draw` makes the SVG of a checkout; it depends on the renderer, these scenes and mistakes."""

    draw: Callable[[Path], bytes]
    scenes: tuple[str, ...]
    mistake: str = ""


def _points(root: Path) -> bytes:
    points = [sampler_points(root, kind, 64) for kind in _KINDS]
    return points_svg(_KINDS, points, [(8, 8)] * 3, 14.0)


def _intervals(root: Path) -> bytes:
    points = sampler_points(root, "sobol", 16)
    titles = [f"{columns} × {rows}" for columns, rows in _CUTS]
    return points_svg(titles, [points] * len(_CUTS), _CUTS, 14.0)


PLOTS = {
    "mc-convergence": Plot(
        lambda root: error_svg(measured.seven_lamps(root), "error of a pixel"),
        (measured.SEVEN,),
    ),
    "grading-bias": Plot(
        lambda root: error_svg(
            measured.bias_of_ambient(root), "error of a tile of 8 × 8 pixels"
        ),
        (measured.SEVEN,), measured.AMBIENT,
    ),
    "samplers-error": Plot(
        lambda root: error_svg(measured.samplers(root), "error of a pixel"), measured.SAMPLED
    ),
    "samplers-points": Plot(_points, ()),
    "samplers-intervals": Plot(_intervals, ()),
}  # fmt: skip


def plot_file(root: Path, cache: Path, name: str) -> Path:
    """The plot's SVG in the cache, up to date; raises BadInput if there is no such plot."""
    if name not in PLOTS:
        raise BadInput(f"no such plot; there are {', '.join(PLOTS)}")
    folder = cache / f"plot-{_key(root, PLOTS[name])}"
    file = folder / f"{name}.svg"
    with locked(folder / ".lock"):
        if not file.is_file():
            write_bytes(file, PLOTS[name].draw(root))
    return file


def _key(root: Path, plot: Plot) -> str:
    """Changes with anything that could change the plot."""
    digest = hashlib.sha256(version("matplotlib").encode())
    for file in sorted(Path(__file__).parent.glob("*.[cp]*")):
        digest.update(file.read_bytes() if file.is_file() else b"")
    picture = Picture("mistake" if plot.mistake else "solution", mistake=plot.mistake)
    for scene in plot.scenes or (measured.SEVEN,):
        digest.update(picture_key(root, FigureSpec("", scene, ""), picture).encode())
    return digest.hexdigest()[:20]
