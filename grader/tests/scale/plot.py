"""The plot of the simulation."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt
from matplotlib.ticker import FixedLocator, FuncFormatter
from model import Run

_UNITS = {60.0: "1 min", 600.0: "10 min", 3600.0: "1 h", 36000.0: "10 h", 86400.0: "1 day",
          864000.0: "10 days", 2592000.0: "30 days"}  # fmt: skip


def plot(file: Path, curves: Mapping[str, Sequence[Run]], title: str) -> None:
    """Time and workers, each with a logarithmic axis; a dotted line is perfect scaling."""
    plt.rcParams["svg.hashsalt"] = "raybook"  # the same bytes each time
    figure, axes = plt.subplots(figsize=(7, 4.6), layout="constrained")
    for (name, runs), colour in zip(
        curves.items(), ("#0b6e99", "#c2571a", "#5b8c3a"), strict=False
    ):
        workers = [run.workers for run in runs]
        axes.plot(workers, [run.seconds for run in runs], "o-", color=colour, label=name, ms=4)
        ideal = [runs[0].seconds / w for w in workers]
        axes.plot(workers, ideal, ":", color=colour, lw=1)
    axes.set_xscale("log", base=2)
    axes.set_yscale("log")
    axes.xaxis.set_major_formatter(FuncFormatter(lambda x, _: f"{x:g}"))
    axes.yaxis.set_major_locator(FixedLocator(list(_UNITS)))
    axes.yaxis.set_major_formatter(FuncFormatter(lambda y, _: _UNITS.get(y, "")))
    axes.minorticks_off()
    axes.grid(alpha=0.3)
    axes.set_xlabel("workers (dotted: each as useful as the first)")
    axes.set_ylabel("time until everything is graded")
    axes.set_title(title)
    axes.legend(frameon=False)
    figure.savefig(file, metadata={"Date": None})
    figure.savefig(file.with_suffix(".png"), dpi=110)
    plt.close(figure)
