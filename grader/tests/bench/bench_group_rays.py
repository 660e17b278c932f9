"""Ray casting beside Embree: groups `rays`, `work`."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

from bench_effort import Effort
from bench_programs import ROOT, ask, program
from bench_rows import Row, ratios, spread

CONTESTS = (("bvh", "embree"), ("wide", "embree"), ("wide-robust", "embree-robust"))
"""Rows: ours, and the peer. Our wide tree has one mode, which is robust: in the one row it meets
Embree as it comes, in the other Embree with the same promise."""

CASTER_OF = {"wide-robust": "wide"}
MISSES_ALLOWED = 1e-4
"""Embree's default mode passes between some triangles and answers some grazing rays in its own way;
that is fewer than one ray in ten thousand on these meshes."""

NO_EMBREE = "Embree is not installed (libembree-dev)"
KINDS = ("primary", "bounce", "shadow")


def ray_rows(effort: Effort) -> Iterator[Row]:
    """A row for each mesh, contest and kind of rays."""
    binary = program()
    names = ["bvh", "wide", "embree", "embree-robust"]
    for mesh in effort.meshes:
        found = ask(binary, "cast", mesh, effort.rays, effort.repeats, *names)
        for name, peer in CONTESTS:
            for kind in KINDS:
                row = Row("rays", name, mesh, kind, peer, unit="Mrays/s")
                yield ray_row(row, found["kinds"][kind], found["rays"])


def ray_row(row: Row, kind: dict[str, Any], rays: int) -> Row:
    """The row's figures, from what `bench cast` says of one kind of rays."""
    caster = CASTER_OF.get(row.name, row.name)
    if caster not in kind:
        return row.missing(f"this build has no accelerator {caster}")
    ours = kind[caster]
    speed = spread([rays / s / 1e6 for s in ours["seconds"]])
    row = replace(row, figure=speed.median, low=speed.low, high=speed.high)
    if row.peer not in kind:
        return replace(row, fault=NO_EMBREE, low=None, high=None)
    peer = kind[row.peer]
    row = row.beside(ratios(peer["seconds"], ours["seconds"]))
    differ = ours["differ"] + peer["differ"]  # each from the BVH's answers
    row = replace(row, note=f"{ours['hits'] / rays:.1%} hit, {differ} of {rays} answers differ")
    if differ > MISSES_ALLOWED * rays:
        return replace(row, fault=f"{differ} of {rays} rays are answered in another way")
    return row


MEDIAN = ROOT / "assignments/03-bvh/alternatives/median-quickselect.c"
LINEAR_RAYS = 200


def work_rows(effort: Effort) -> Iterator[Row]:
    """Boxes and triangles tested for a ray: the taught tree beside none, and beside one that is
    split in the middle. Counted, not timed: the same on every machine."""
    mesh = effort.meshes[0]
    sah = ask(program(), "work", mesh, effort.rays, "bvh")
    linear = ask(program(), "work", mesh, LINEAR_RAYS, "linear")
    some = ask(program(), "work", mesh, LINEAR_RAYS, "bvh")
    median = ask(program("bench-median", ("accel/bvh.o", MEDIAN)), "work", mesh, effort.rays, "bvh")
    for kind in KINDS:
        row = Row("work", "bvh", mesh, kind, "linear", unit="nodes and triangles a ray")
        yield _work_row(row, sah, linear, kind, same=_hits(some) == _hits(linear))
        yield _work_row(
            replace(row, peer="median split"), sah, median, kind, same=_hits(sah) == _hits(median)
        )


def _work_row(row: Row, ours: Any, peer: Any, kind: str, same: bool) -> Row:
    figure, other = _work(ours, kind), _work(peer, kind)
    found = replace(
        row,
        figure=figure,
        ratio=other / figure,
        low=other / figure,
        high=other / figure,
        note=f"{row.peer}: {other:.1f}",
    )
    return found if same else replace(found, fault="the two do not hit the same")


def _work(found: Any, kind: str) -> float:
    counts = found["kinds"][kind]
    return float(counts["boxes"] + counts["primitives"]) / float(found["rays"])


def _hits(found: Any) -> list[int]:
    return [found["kinds"][kind]["hits"] for kind in KINDS]
