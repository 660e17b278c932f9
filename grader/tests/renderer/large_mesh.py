"""Meshes and scenes of many triangles, for measuring what they take."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np
from renderer_runs import Json, diffuse, mesh

OWN_MEMORY = ("sh", "-c", '"$@"; exit $?', "sh")
"""Before a command: a process that is started by a large one inherits the peak of its memory, one
that is started by a small shell does not."""


def write_ring(path: Path, triangles: int) -> int:
    """A closed, dented ring of about so many triangles with texture coordinates, as an OBJ file;
    how many there are. 10 million are 760 MB of text."""
    side = round(math.sqrt(triangles / 2))
    aside = path.with_suffix(".new")
    with aside.open("w", encoding="ascii") as out:
        out.writelines(_vertices(side))
        out.writelines(_faces(side))
    aside.replace(path)
    return 2 * side * side


def _vertices(side: int) -> Iterator[str]:
    around = np.linspace(0, 2 * np.pi, side, endpoint=False)
    for i, along in enumerate(around):
        radius = 0.35 * (1 + 0.1 * np.sin(40 * around) * np.cos(37 * along))
        out = 1 + radius * np.cos(around)
        point = (out * np.cos(along), radius * np.sin(around), out * np.sin(along))
        yield _lines("v %.7f %.7f %.7f\n", np.stack(point, axis=1))
        uv = (np.full(side, i / side), np.arange(side) / side)
        yield _lines("vt %.6f %.6f\n", np.stack(uv, axis=1))


def _faces(side: int) -> Iterator[str]:
    here = np.arange(side) + 1
    after = np.roll(here, -1)
    for i in range(side):
        row, next_row = i * side, (i + 1) % side * side
        a, b, c, d = row + here, next_row + here, next_row + after, row + after
        corners = np.stack((a, a, c, c, b, b, a, a, d, d, c, c), axis=1)
        yield _lines("f %d/%d %d/%d %d/%d\nf %d/%d %d/%d %d/%d\n", corners)


def _lines(form: str, values: np.ndarray[tuple[int, ...], np.dtype[np.generic]]) -> str:
    """The form, once for each row of values."""
    return (form * len(values)) % tuple(values.ravel().tolist())


def show(paths: Sequence[str | Path], distance: float) -> Json:
    """A scene of these meshes, moved apart if there are several, in the light of a sun."""
    side = round(len(paths) ** (1 / 3) + 0.49)
    places = [(i % side, i // side % side, i // side**2) for i in range(len(paths))]
    objects = [
        mesh(str(path), "clay", translate=[4.0 * (c - (side - 1) / 2) for c in place])
        for path, place in zip(paths, places, strict=True)
    ]
    return {
        "integrator": {"type": "path", "spp": 4, "max_depth": 3},
        "film": {"resolution": [320, 240]},
        "camera": {"position": [0, distance, distance], "look_at": [0, 0, 0], "fov": 45},
        "lights": [{"type": "directional", "direction": [-0.5, -1, -0.6], "irradiance": [3, 3, 3]}],
        "objects": objects,
        **diffuse(clay=(0.7, 0.5, 0.4)),
    }
