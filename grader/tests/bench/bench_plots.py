"""The plots for the book: drawn on nothing, in colours that can be read on white and on black."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt
from bench_group_textures import Curves
from bench_rows import Row
from matplotlib.figure import Figure

INK = "#7f7f7f"
COLOURS = ("#3b8ac4", "#d0752b", "#5f9e4d", "#a86bb5")
STYLE: Any = {
    "svg.fonttype": "none",
    "svg.hashsalt": "raybook",  # the same bytes each time
    "font.family": "sans-serif",
    "text.color": INK,
    "axes.labelcolor": INK,
    "axes.edgecolor": INK,
    "xtick.color": INK,
    "ytick.color": INK,
    "axes.spines.top": False,
    "axes.spines.right": False,
}


OURS = "SAH BVH"


class WorkRow(NamedTuple):
    """A row of the group `work` that was measured."""

    kind: str
    peer: str
    figure: float
    ratio: float


def plots(rows: Sequence[Row], curves: Curves | None, folder: Path) -> list[Path]:
    """Those for which there are measurements; the files written."""
    with plt.rc_context(STYLE):
        drawn = [
            _ratios(rows, "rays", "Rays a second, beside Embree (1: as fast)", ("name",)),
            _ratios(rows, "images", "Samples a second, beside Mitsuba 3", ("peer",)),
            _ratios(rows, "variance x time", "1 / (variance x time), beside Mitsuba 3", ("peer",)),
            _ratios(rows, "sampling", "Variance, plain over better", ("peer",), log=True),
            _work(rows),
            _curves(curves),
        ]
        names = ("rays", "images", "efficiency", "sampling", "work", "textures")
        files = []
        for name, figure in zip(names, drawn, strict=True):
            if figure is not None:
                files.append(folder / f"{name}.svg")
                figure.savefig(files[-1], metadata={"Date": None}, transparent=True)
                plt.close(figure)
        return files


def _ratios(
    rows: Sequence[Row], group: str, title: str, by: tuple[str, ...], log: bool = False
) -> Figure | None:
    """Bars of the ratios with their spread; a short line is the goal."""
    chosen = [row for row in rows if row.group == group and row.ratio is not None]
    if not chosen:
        return None
    figure, axes = plt.subplots(figsize=(7, 0.7 + 0.26 * len(chosen)), layout="constrained")
    keys = list(dict.fromkeys(tuple(getattr(row, field) for field in by) for row in chosen))
    for i, row in enumerate(chosen):
        assert row.ratio is not None
        colour = COLOURS[keys.index(tuple(getattr(row, field) for field in by)) % len(COLOURS)]
        low, high = row.low or row.ratio, row.high or row.ratio
        reach = [[max(0.0, row.ratio - low)], [max(0.0, high - row.ratio)]]
        axes.barh(i, row.ratio, color=colour, height=0.7, xerr=reach, ecolor=INK)
        if row.goal is not None and row.goal.of == "ratio":
            axes.plot([row.goal.value] * 2, [i - 0.4, i + 0.4], color=INK, lw=2)
    axes.set_yticks(range(len(chosen)), [_label(row) for row in chosen])
    axes.invert_yaxis()
    if log:
        axes.set_xscale("log")
    else:
        axes.axvline(1, color=INK, lw=0.8, ls=":")
    axes.set_title(title, fontsize=11)
    return figure


def _label(row: Row) -> str:
    parts = (row.name, row.kind, row.scene, row.peer.removeprefix("mitsuba "))
    return ", ".join(filter(None, parts))


def _work(rows: Sequence[Row]) -> Figure | None:
    chosen = [
        WorkRow(row.kind, row.peer, row.figure, row.ratio)
        for row in rows
        if row.group == "work" and row.ratio is not None and row.figure is not None
    ]
    if not chosen:
        return None
    figure, axes = plt.subplots(figsize=(7, 3.2), layout="constrained")
    kinds = list(dict.fromkeys(row.kind for row in chosen))
    peers = list(dict.fromkeys(row.peer for row in chosen))
    tested = {(row.kind, row.peer): row.figure * row.ratio for row in chosen}
    tested |= {(row.kind, OURS): row.figure for row in chosen}
    for k, name in enumerate([*peers, OURS]):
        heights = [tested[kind, name] for kind in kinds]
        places = [x + 0.27 * (k - 1) for x in range(len(kinds))]
        bars = axes.bar(places, heights, width=0.25, color=COLOURS[k], label=name)
        axes.bar_label(bars, [f"{h:.0f}" for h in heights], color=INK, fontsize=8)
    axes.set_yscale("log")
    axes.set_ylim(bottom=1)
    axes.set_xticks(range(len(kinds)), kinds)
    axes.set_title("Boxes and triangles tested a ray", fontsize=11)
    axes.legend(frameon=False, loc="upper left", bbox_to_anchor=(1, 1))
    return figure


def _curves(curves: Curves | None) -> Figure | None:
    if curves is None:
        return None
    figure, axes = plt.subplots(figsize=(7, 3.6), layout="constrained")
    for (name, points), colour in zip(curves.items(), COLOURS, strict=False):
        seconds, errors = [p.seconds for p in points], [p.error for p in points]
        axes.plot(seconds, errors, "o-", color=colour, ms=4, label=name)
        for point in points:
            axes.annotate(
                str(point.spp), (point.seconds, point.error), xytext=(3, 4),
                textcoords="offset points", fontsize=7,
            )  # fmt: skip
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel("seconds (the numbers: samples a pixel)")
    axes.set_ylabel("mean square error")
    axes.set_title("A filtered texture, and more samples instead", fontsize=11)
    axes.legend(frameon=False)
    return figure
