"""The oracle of ``intersection_test_radiance``: groups "mirrors", "glass" and "deep".

"mirrors" asks the integrator alone, "glass" the whole module: light that is bent comes out of the
student's own refraction_direction. Both hold hand-picked and random scenes. "deep" is for the
sanitizers: hand-picked scenes, and stacks of forty panes.

chain_tracer.py finds what is right, chain_bounds.py how exact an answer must be; probe_chain.c says
how the files are laid out.
"""

from __future__ import annotations

import json
import struct
from collections.abc import Iterator
from dataclasses import dataclass

import chain_picked
import chain_random
import numpy as np
from chain_bounds import bounds
from chain_scenes import Shot
from chain_things import Array, Json
from chain_tracer import ABSORBED, LEFT, NO_MATERIAL, TOO_DEEP, UNLIT
from numpy.typing import NDArray
from raybook_grader.cases import point, wrong_length
from raybook_grader.probes import Cases, Failure

WORDS_OUT = 3
ALMOST_BLACK = 1e-6
"""Against radiances of about 1: what is black need not be so to the last bit."""


@dataclass(frozen=True)
class Context:
    """The cases: rays through scenes. ``scene_of`` says which, and ``met`` what they met there."""

    scenes: list[Json]
    label: list[str]
    scene_of: NDArray[np.int64]
    origin: Array
    direction: Array
    radiance: Array
    tolerance: Array
    throughput: Array
    end: NDArray[np.int64]
    met: list[list[int]]
    mirrored: list[list[bool]]


def make_cases(group: str, seed: int) -> Cases:
    """Hand-picked and random rays; the same for the same seed."""
    rng = np.random.default_rng(seed)
    if group == "mirrors":
        shots = [*chain_picked.mirrors(), *chain_random.mirrors(rng)]
    elif group == "glass":
        shots = [*chain_picked.glasses(), *chain_random.glasses(rng)]
    elif group == "deep":
        shots = [*chain_picked.deep(), *chain_picked.mirrors([1.0]), *chain_picked.glasses([1.0])]
    else:
        raise ValueError(f"group {group!r}, expected 'mirrors', 'glass' or 'deep'")
    payload, context = _collect(shots)
    return Cases(payload, len(context.end), context)


def judge(cases: Cases, output: bytes) -> list[Failure]:
    """Every wrong result, told in words."""
    if faults := wrong_length(output, 4 * WORDS_OUT, cases.count):
        return faults
    context: Context = cases.context
    got = np.frombuffer(output, "<f4").reshape(-1, WORDS_OUT).astype(np.float64)
    with np.errstate(invalid="ignore"):
        good = (np.abs(got - context.radiance) <= context.tolerance + ALMOST_BLACK).all(axis=1)
    return [_failure(context, int(case), got[case]) for case in np.flatnonzero(~good)]


def _collect(shots: list[Shot]) -> tuple[bytes, Context]:
    """The rays that have one right answer, and what the driver reads of them."""
    payload, parts = [], []
    met: list[list[int]] = []
    mirrored: list[list[bool]] = []
    for number, shot in enumerate(shots):
        ways, tolerance, kept = bounds(shot.scene, shot.origin, shot.direction)
        rays = np.hstack([shot.origin, shot.direction])[kept].astype("<f4")
        text = json.dumps(shot.scene).encode()
        payload += [
            struct.pack("<I", len(text)),
            text,
            struct.pack("<I", len(rays)),
            rays.tobytes(),
        ]
        columns = (shot.origin, shot.direction, ways.radiance, tolerance, ways.throughput)
        rest = np.column_stack([np.full(len(kept), number), ways.end])
        parts.append(np.hstack([*columns, rest])[kept])
        met += [[int(i) for i in row if i >= 0] for row in ways.met[kept]]
        mirrored += [[bool(m) for m in row] for row in ways.total[kept]]
    table = np.concatenate(parts)
    origin, direction, radiance, tolerance, throughput = (
        table[:, i : i + 3] for i in range(0, 15, 3)
    )
    scene_of, end = table[:, 15].astype(int), table[:, 16].astype(int)
    return b"".join(payload), Context(
        [shot.scene for shot in shots], [shot.label for shot in shots], scene_of,
        origin, direction, radiance, tolerance, throughput, end, met, mirrored,
    )  # fmt: skip


# --- Words -----------------------------------------------------------------------------------

BLACK = {
    LEFT: "then nothing",
    UNLIT: "which no light reaches",
    NO_MATERIAL: "which has no material",
    TOO_DEEP: "which is one clear surface too many",
    ABSORBED: "which lets nothing on",
}


def _failure(context: Context, case: int, got: Array) -> Failure:
    scene = context.scenes[context.scene_of[case]]
    limit = scene["integrator"]["max_depth"]
    message = (
        f"{context.label[context.scene_of[case]]}: max_depth {limit}, a ray from "
        f"{point(context.origin[case])} along {point(context.direction[case])} "
        f"{_way(context, case, scene)}: expected {point(context.radiance[case])}, got {point(got)}"
    )
    kind = _kind(context, case, got)
    return Failure(case, message, kind, -float(100 * len(context.met[case]) + len(message)))


def _way(context: Context, case: int, scene: Json) -> str:
    """What the ray meets, one after the other, and how it ends."""
    met = ", then ".join(_steps(context, case, scene))
    if not met:
        return "meets nothing"
    why = BLACK.get(int(context.end[case]))
    return f"meets {met}" + (f", {why}" if why else "")


def _steps(context: Context, case: int, scene: Json) -> Iterator[str]:
    met = context.met[case]
    ends = context.end[case] in (TOO_DEEP, ABSORBED)
    for i, index in enumerate(met):
        entry = scene["objects"][index]
        material = scene["materials"].get(entry.get("material_name"))
        kind, it = entry["type"], f"(object {index})"
        if material is None:
            yield f"a {kind} {it}"
        elif material["type"] not in ("refraction", "glass"):
            yield f"a {material['type']} {kind} {it}"
        else:
            does = "mirrors it" if context.mirrored[case][i] else "lets it through"
            last = ends and i == len(met) - 1
            yield f"a {kind} of index {material['eta']:g} {it}" + ("" if last else f" that {does}")


def _kind(context: Context, case: int, got: Array) -> str:
    """The kind of error in a few stable words."""
    clear = len(context.met[case]) - 1
    behind = "nothing clear" if clear == 0 else "one clear surface" if clear == 1 else "several"
    if not np.isfinite(got).all():
        return "not a number"
    if (context.radiance[case] == 0).all():
        return f"not black: {BLACK[int(context.end[case])]}"
    if (got == 0).all():
        return f"black: behind {behind}"
    with np.errstate(all="ignore"):
        bare = context.radiance[case] / context.throughput[case]
        close = np.abs(got - bare) <= context.tolerance[case] + 1e-3 * bare
    if clear and close.all():
        return "the weights are left out"
    return f"wrong light: behind {behind}"
