"""How the plots look. The same data gives the same bytes."""

from __future__ import annotations

import io
from collections.abc import Sequence
from typing import Any

import matplotlib
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

from ...judge.pixels import Array
from .curves import Panel

_COLOURS = {"orange": "#b8500c", "blue": "#1b5fa8", "green": "#2f7d4f", "grey": "#8795a5"}
_TICKS = tuple(digit * 10.0**power for power in range(-4, 2) for digit in (1, 2, 5))
_SETTINGS: dict[Any, Any] = {
    "font.family": "DejaVu Sans",
    "font.size": 10.5,
    "svg.fonttype": "path",  # the same everywhere
    "svg.hashsalt": "raybook",
    "axes.edgecolor": _COLOURS["grey"],
    "xtick.color": "#222",
    "ytick.color": "#222",
}
_INCHES = 7.6


def error_svg(panels: Sequence[Panel], what: str) -> bytes:
    """Error over samples a pixel, both axes logarithmic."""
    with matplotlib.rc_context(_SETTINGS):
        single = len(panels) == 1
        figure = Figure((_INCHES, 3.3), layout="constrained")
        all_axes = figure.subplots(1, len(panels), squeeze=False)[0]
        for axes, panel in zip(all_axes, panels, strict=True):
            _curves(axes, panel, at_end=single)
            axes.set_title(panel.title or what, loc="left", fontsize=10.5)
        if not single:
            handles, labels = all_axes[0].get_legend_handles_labels()
            figure.legend(handles, labels, loc="outside lower center", ncols=3, frameon=False)
        return _svg(figure)


def points_svg(titles: Sequence[str], points: Sequence[Array],
               grids: Sequence[tuple[int, int]], size: float) -> bytes:  # fmt: skip
    """Unit squares side by side, each with a grid and points of the area `size`."""
    with matplotlib.rc_context(_SETTINGS):
        figure = Figure((_INCHES, _INCHES / len(points) + 0.35), layout="constrained")
        rows = figure.subplots(1, len(points), squeeze=False)[0]
        for axes, title, own, grid in zip(rows, titles, points, grids, strict=True):
            _square(axes, grid)
            axes.scatter(own[:, 0], own[:, 1], s=size, color=_COLOURS["blue"], zorder=3)
            axes.set_xlabel(title)
        return _svg(figure)


def _curves(axes: Axes, panel: Panel, at_end: bool) -> None:
    axes.set_xscale("log", base=4)
    axes.set_yscale("log")
    for curve in panel.curves:
        colour, _, dashed = curve.style.partition("-")
        samples, errors = zip(*curve.errors, strict=True)
        axes.plot(samples, errors, marker="o", markersize=5, linewidth=1.8, label=curve.label,
                  color=_COLOURS[colour], linestyle="--" if dashed else "-")  # fmt: skip
    _scales(axes, [n for n, _ in panel.curves[0].errors])
    if at_end:
        axes.legend(loc="center left", bbox_to_anchor=(1.02, 0.5), frameon=False)


def _scales(axes: Axes, samples: Sequence[int]) -> None:
    axes.xaxis.set_major_locator(FixedLocator(list(samples)))
    axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:.0f}"))
    axes.yaxis.set_major_locator(FixedLocator(list(_TICKS)))
    axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{100 * value:g} %"))
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_minor_locator(NullLocator())
    axes.set_xlabel("samples a pixel")
    axes.grid(color=_COLOURS["grey"], linewidth=0.5, alpha=0.5)


def _square(axes: Axes, grid: tuple[int, int]) -> None:
    columns, rows = grid
    axes.set(xlim=(0, 1), ylim=(0, 1), aspect="equal", xticks=[], yticks=[])
    for n in range(1, columns):
        axes.axvline(n / columns, color="#ccd4dd", linewidth=0.7)
    for n in range(1, rows):
        axes.axhline(n / rows, color="#ccd4dd", linewidth=0.7)


def _svg(figure: Figure) -> bytes:
    stream = io.BytesIO()
    figure.savefig(stream, format="svg", metadata={"Date": None, "Creator": None})
    return stream.getvalue()
