"""Building the structures: groups `build`, `memory`, `threads` (of the build)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

from bench_effort import Effort
from bench_group_rays import NO_EMBREE
from bench_machine import busy, processors
from bench_programs import ask, program
from bench_rows import Row, ratios, spread

OURS = ("bvh", "wide")
PEER = "embree:1"


def build_rows(effort: Effort) -> Iterator[Row]:
    """Time on one thread and memory, beside Embree's; and what a second thread gains."""
    binary = program()
    for mesh in effort.meshes:
        labels = [*(f"{name}:1" for name in OURS), PEER]
        alone = ask(binary, "build", mesh, effort.builds, *labels)
        for name in OURS:
            yield _time_row(Row("build", name, mesh, "", "embree", unit="s/Mtri"), alone)
            yield _memory_row(Row("memory", name, mesh, "", "embree", unit="B/tri"), alone)
        yield _threads_row(Row("threads", "build", mesh, "wide", "1 thread", unit="s"), effort)


def _time_row(row: Row, found: Any) -> Row:
    label = f"{row.name}:1"
    if label not in found["casters"]:
        return row.missing(f"this build has no accelerator {row.name}")
    ours, millions = found["casters"][label]["cpu"], found["triangles"] / 1e6
    took = spread([s / millions for s in ours])
    row = replace(row, figure=took.median, low=took.low, high=took.high)
    if PEER not in found["casters"]:
        return replace(row, fault=NO_EMBREE)
    return row.beside(ratios(ours, found["casters"][PEER]["cpu"]))


def _memory_row(row: Row, found: Any) -> Row:
    label = f"{row.name}:1"
    if label not in found["casters"]:
        return row.missing(f"this build has no accelerator {row.name}")
    figure = found["casters"][label]["bytes"] / found["triangles"]
    if PEER not in found["casters"]:
        return replace(row, figure=figure, fault="" if row.goal else NO_EMBREE)
    ratio = figure / (found["casters"][PEER]["bytes"] / found["triangles"])
    return replace(row, figure=figure, ratio=ratio, low=ratio, high=ratio)


def _threads_row(row: Row, effort: Effort) -> Row:
    if len(processors()) < 2:
        return row.missing("this machine has one processor")
    labels = [f"{row.kind}:1", f"{row.kind}:2"]
    found = ask(program(), "build", row.scene, effort.builds, *labels, alone=False)["casters"]
    if labels[0] not in found:
        return row.missing(f"this build has no accelerator {row.kind}")
    one, two = (found[label]["wall"] for label in labels)
    return replace(row, figure=spread(two).median, note=busy()).beside(ratios(one, two))
