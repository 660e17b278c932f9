"""Measure Raybook beside its peers: bench.py [--full] [--only rays,images]

Writes build/bench/bench.json, a Markdown table (bench.md) and SVG plots. A row's ratio is the
median over repetitions in which ours and the peer take turns on one processor; rows that have a
goal say whether it is reached. A peer that is not there gives rows that say so. Nothing is written
until all is measured: a run that is stopped leaves the last one's files as they are.

--full takes up to 25 minutes and installs Mitsuba into an environment of its own (500 MB) if that
is not there; without it, it takes up to 3 minutes.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from pathlib import Path

from bench_effort import FULL, QUICK, TINY, Effort
from bench_goals import with_goals
from bench_group_build import build_rows
from bench_group_grader import grader_rows
from bench_group_images import image_rows, thread_rows
from bench_group_large import large_rows
from bench_group_rays import ray_rows, work_rows
from bench_group_sampling import sampling_rows
from bench_group_start import loading_rows, start_rows
from bench_group_textures import texture_curves, texture_rows
from bench_machine import describe
from bench_plots import plots
from bench_programs import BUILD
from bench_rows import Row
from bench_tables import markdown, progress

from raybook_grader.files import write_text

EFFORTS = {"full": FULL, "quick": QUICK, "tiny": TINY}
GROUPS: Mapping[str, Callable[[Effort], Iterable[Row]]] = {
    "rays": ray_rows,
    "build": build_rows,
    "work": work_rows,
    "images": image_rows,
    "sampling": sampling_rows,
    "textures": texture_rows,
    "threads": thread_rows,
    "loading": loading_rows,
    "large": large_rows,
    "start": start_rows,
    "grader": grader_rows,
}


def main(arguments: Sequence[str] | None = None) -> int:
    """The command; see the top of this file."""
    given = _arguments(arguments)
    effort, begun = EFFORTS[given.effort], time.monotonic()
    machine = describe()
    print("; ".join(f"{name}: {value}" for name, value in machine.items()), flush=True)
    rows = []
    try:
        for row in measured(effort, given.only):
            rows.append(row)
            print(*progress([row]), flush=True)
    except KeyboardInterrupt:
        print("stopped; nothing was written", file=sys.stderr)
        return 130
    seconds = time.monotonic() - begun
    write(given.out, rows, machine, effort.name, seconds)
    judged = [row for row in rows if row.goal is not None]
    print(f"{sum(row.met is True for row in judged)} of {len(judged)} goals reached, ", end="")
    print(f"{seconds:.0f} s: {given.out}/bench.json, bench.md, *.svg")
    return 0


def measured(effort: Effort, only: Sequence[str]) -> Iterator[Row]:
    """The rows of these groups (none: of all). A group that fails has one row, which says why."""
    for name, group in GROUPS.items():
        if not only or name in only:
            yield from with_goals(_guarded(name, group(effort)))


def _guarded(name: str, rows: Iterable[Row]) -> Iterator[Row]:
    try:
        yield from rows
    except subprocess.CalledProcessError as error:
        yield Row(name, "failed", "").missing(f"{error}: {(error.stderr or '').strip()[-300:]}")
    except (OSError, RuntimeError, AssertionError) as error:
        yield Row(name, "failed", "").missing(str(error)[-300:])


def write(
    folder: Path, rows: Sequence[Row], machine: Mapping[str, object], mode: str, seconds: float
) -> None:
    """All files, each complete or absent."""
    folder.mkdir(parents=True, exist_ok=True)
    found = {
        "mode": mode,
        "machine": dict(machine),
        "seconds": round(seconds, 1),
        "rows": [row.values() for row in rows],
    }
    write_text(folder / "bench.json", json.dumps(found, indent=1, ensure_ascii=False) + "\n")
    write_text(folder / "bench.md", markdown(rows, machine, mode, seconds))
    plots(rows, texture_curves(), folder)


def _arguments(arguments: Sequence[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(description="Measures Raybook beside its peers.")
    parser.set_defaults(effort="quick")
    for name, effort in EFFORTS.items():
        parser.add_argument(
            f"--{name}", dest="effort", action="store_const", const=name, help=effort.about
        )
    parser.add_argument("--only", metavar="LIST", default=[], type=_groups,
                        help=f"of {','.join(GROUPS)}")  # fmt: skip
    parser.add_argument("--out", metavar="DIR", type=Path, default=BUILD)
    return parser.parse_args(arguments)


def _groups(text: str) -> list[str]:
    names = text.split(",")
    if unknown := set(names) - GROUPS.keys():
        raise argparse.ArgumentTypeError(f"no group {', '.join(sorted(unknown))}")
    return names


if __name__ == "__main__":
    sys.exit(main())
