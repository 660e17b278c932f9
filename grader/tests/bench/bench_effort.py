"""How much is measured: the whole, a few minutes' worth, or just enough to see that it runs."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Effort:
    """Sizes and repetitions of all groups."""

    name: str
    about: str
    meshes: tuple[str, ...]
    rays: int
    repeats: int  # of what takes a fraction of a second
    builds: int  # of structures over a mesh
    side: int  # of the pictures that are compared, in pixels
    seeds: int  # pictures of each renderer
    spp: int
    samplers: tuple[str, ...]  # Mitsuba's at its best: the one that is best for it
    long_rows: bool  # what takes minutes and has no goal
    obj_triangles: int
    large_triangles: int  # of a mesh whose memory is measured; 0: it is left out
    modules: int  # that the grader judges
    may_install: bool  # Mitsuba, of 500 MB


FULL = Effort(
    name="full",
    about="everything; up to 25 minutes",
    meshes=("knot", "terrain"),
    rays=1_000_000,
    repeats=9,
    builds=5,
    side=192,
    seeds=6,
    spp=32,
    samplers=("multijitter", "ldsampler"),
    long_rows=True,
    obj_triangles=1_000_000,
    large_triangles=10_000_000,
    modules=20,
    may_install=True,
)

QUICK = Effort(
    name="quick",
    about="up to 3 minutes (default)",
    meshes=("knot", "terrain"),
    rays=200_000,
    repeats=5,
    builds=2,
    side=96,
    seeds=3,
    spp=16,
    samplers=("multijitter",),
    long_rows=False,
    obj_triangles=1_000_000,
    large_triangles=0,
    modules=1,
    may_install=False,
)

TINY = Effort(
    name="tiny",
    about="too little to mean anything: does it run?",
    meshes=("box",),
    rays=2_000,
    repeats=2,
    builds=2,
    side=16,
    seeds=2,
    spp=4,
    samplers=("independent",),
    long_rows=False,
    obj_triangles=2_000,
    large_triangles=0,
    modules=1,
    may_install=False,
)
