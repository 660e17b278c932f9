"""The measurements for reading: a Markdown table, and the lines that are printed meanwhile."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence

from bench_rows import Row

HEAD = (
    "| group | what | scene | peer | figure | ratio | extent | goal (beyond) | reached | note |\n"
    "| --- | --- | --- | --- | --: | --: | --: | --: | --- | --- |\n"
)

EXPLAINED = """\
Ratios are the medians over the repetitions, in which ours and the peer take turns, bound to one \
processor; the extent is from the least to the greatest. What counts is processor time, but for \
threads, loading and the start, where it is the clock. In the groups build and memory a ratio is \
what ours takes for each 1 of the peer's; everywhere else it is how many times better ours is. \
Variance x time is compared by its inverse, and there and in sampling the extent is one standard \
error.
"""


def markdown(rows: Sequence[Row], machine: Mapping[str, object], mode: str, seconds: float) -> str:
    """The whole page."""
    parts = "; ".join(f"{name.replace('_', ' ')}: {value}" for name, value in machine.items())
    judged = [row for row in rows if row.goal is not None]
    reached = sum(row.met is True for row in judged)
    text = f"# make bench, {mode}\n\n{parts}. {seconds:.0f} seconds.\n\n{EXPLAINED}\n"
    text += f"{reached} of {len(judged)} rows with a goal reach it.\n\n{HEAD}"
    return text + "".join(map(line, rows))


def line(row: Row) -> str:
    """One row of the table."""
    what = f"{row.name}, {row.kind}" if row.kind else row.name
    figure = "" if row.figure is None else f"{number(row.figure)} {row.unit}"
    ratio = "" if row.ratio is None else number(row.ratio)
    extent = (
        f"{number(row.low)} .. {number(row.high)}"
        if row.low is not None and row.high is not None and row.low != row.high
        else ""
    )
    reached = {None: "", True: "reached", False: "**not reached**"}[row.met]
    note = "; ".join(filter(None, (row.fault, row.note)))
    cells = [row.group, what, row.scene, row.peer, figure, ratio, extent]
    return "| " + " | ".join([*cells, str(row.goal or ""), reached, note]) + " |\n"


def number(value: float) -> str:
    """Three digits."""
    if abs(value) >= 1e4 or (value != 0 and abs(value) < 1e-3):
        return f"{value:.2e}"
    return f"{value:.0f}" if abs(value) >= 100 else f"{value:.3g}"


def progress(rows: Iterable[Row]) -> Iterator[str]:
    """For the terminal."""
    for row in rows:
        what = " ".join(filter(None, (row.group, row.name, row.kind, row.scene, row.peer)))
        figure = "" if row.figure is None else f"{number(row.figure)} {row.unit}"
        ratio = "" if row.ratio is None else f"ratio {number(row.ratio)}"
        goal = "" if row.goal is None else f"{row.goal}: {'reached' if row.met else 'NOT REACHED'}"
        yield f"{what:64s} {'  '.join(filter(None, (figure, ratio, goal, row.fault)))}"
