"""How the time for 100,000 submissions falls with workers, and where it stops.

    build/venv/bin/python grader/tests/scale/simulate.py [--measure] [--each N] [--no-validation]

measures how long grading takes (kept in build/simulation/durations.json) and what a cluster adds to
that, feeds both to a discrete-event model, compares the model with real runs of one and two
workers, and writes build/simulation/simulation.json, .md and .svg.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
from collections.abc import Iterator, Sequence
from dataclasses import asdict
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "cluster"))
from demand import Demand
from durations import Duration, measured
from model import Overheads, Run, simulate
from overheads import Measured, measure
from plot import plot
from validation import Comparison, real_jobs, sleeping_jobs

from raybook_grader.files import write_text

CHECKOUT = Path(__file__).resolve().parents[3]
OUT = CHECKOUT / "build" / "simulation"
WORKERS = [2**k for k in range(13)]
SUBMISSIONS = 100_000
CLASSES = {
    "a third different, and less in a larger class": Demand(SUBMISSIONS, growth=0.9),
    "a third different, however large the class": Demand(SUBMISSIONS, growth=1.0),
}


def main() -> int:
    """Measure, simulate, compare, write."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    parser.add_argument("--measure", action="store_true", help="time the grading of modules anew")
    parser.add_argument(
        "--each", type=int, default=2, help="modules of each kind timed an assignment"
    )
    parser.add_argument("--no-validation", action="store_true", help="without the real runs")
    arguments = parser.parse_args()
    OUT.mkdir(parents=True, exist_ok=True)
    if arguments.measure:
        (OUT / "durations.json").unlink(missing_ok=True)
    durations = measured(OUT / "durations.json", CHECKOUT, arguments.each)
    costs = measure(CHECKOUT)
    curves = {}
    for name, demand in CLASSES.items():
        jobs = demand.jobs(durations)
        curves[name] = [simulate(jobs, workers, costs.overheads) for workers in WORKERS]
    checks = [] if arguments.no_validation else list(_validate(durations, costs.overheads))
    write_text(
        OUT / "simulation.json", json.dumps(_values(durations, costs, curves, checks), indent=1)
    )
    text = "\n".join(_report(durations, costs, curves, checks))
    write_text(OUT / "simulation.md", text + "\n")
    plot(OUT / "simulation.svg", curves, f"{SUBMISSIONS:,} submissions of all assignments")
    print(text)
    print(f"\n{OUT / 'simulation.json'}, .md, .svg")
    return 0


def _validate(durations: Sequence[Duration], over: Overheads) -> Iterator[Comparison]:
    for workers in (1, 2):
        yield real_jobs(CHECKOUT, durations, over, workers)
    jobs = Demand(200, growth=1.0).jobs(durations)
    for workers in (1, 2, 8):
        yield sleeping_jobs(jobs, over, workers)


def _values(
    durations: Sequence[Duration],
    costs: Measured,
    curves: dict[str, list[Run]],
    checks: Sequence[Comparison],
) -> dict[str, object]:
    return {
        "submissions": SUBMISSIONS,
        "durations": [asdict(d) for d in durations],
        "costs": asdict(costs),
        "classes": {
            name: {**asdict(CLASSES[name]), "different_modules": CLASSES[name].different(),
                   "runs": [{**asdict(r), "stopped_by": r.stopped_by} for r in runs]}
            for name, runs in curves.items()
        },
        "validation": [{**asdict(c), "ratio": c.ratio} for c in checks],
        "load_average": os.getloadavg(),
    }  # fmt: skip


def _report(
    durations: Sequence[Duration],
    costs: Measured,
    curves: dict[str, list[Run]],
    checks: Sequence[Comparison],
) -> Iterator[str]:
    seconds = sorted(d.cpu_seconds for d in durations)
    over = costs.overheads
    yield (
        f"Grading a module ({len(seconds)} timed): median {seconds[len(seconds) // 2]:.1f} s, mean "
        f"{sum(seconds) / len(seconds):.1f} s, longest {seconds[-1]:.1f} s of processor time."
    )
    yield (
        f"A job costs besides: scheduler {over.scheduler * 1e3:.1f} ms, client "
        f"{over.take * 1e3:.1f} ms, storing its result {over.store * 1e3:.1f} ms; result "
        f"{costs.result_bytes / 1e6:.2f} MB, {costs.stored_bytes / 1e6:.2f} MB on the disk; "
        f"a worker waits {2 * over.latency * 1e3:.0f} ms between two jobs."
    )
    for name, runs in curves.items():
        jobs = CLASSES[name].different()
        yield f"\n## {SUBMISSIONS:,} submissions, {name}\n"
        yield f"{jobs:,} different modules of each assignment.\n"
        yield "| workers | time | faster than one | workers busy | storing busy | stopped by |"
        yield "| ---: | ---: | ---: | ---: | ---: | --- |"
        for run in runs:
            yield (
                f"| {run.workers} | {_time(run.seconds)} | {runs[0].seconds / run.seconds:.1f} | "
                f"{run.busy_workers:.0%} | {run.busy_client:.0%} | {run.stopped_by} |"
            )
    if checks:
        yield "\n## The model and real runs\n"
        yield "| run | workers | predicted | measured | ratio | slowed down by others |"
        yield "| --- | ---: | ---: | ---: | ---: | ---: |"
    for c in checks:
        yield (
            f"| {c.what} | {c.workers} | {c.predicted_seconds:.1f} s | {c.measured_seconds:.1f} s "
            f"| {c.ratio:.2f} | {c.slowdown:.2f} |"
        )


def _time(seconds: float) -> str:
    for unit, name in ((86400, "days"), (3600, "h"), (60, "min")):
        if seconds >= 2 * unit:
            return f"{seconds / unit:.1f} {name}"
    return f"{seconds:.0f} s"


if __name__ == "__main__":
    sys.exit(main())
