"""Six meshes on which accelerators and triangle tests are tried, five of them closed.

Each comes with points inside it; the open one with none. Corners are shared by their bits, so that
a closed mesh has no cracks but those that a triangle test makes.
"""

from __future__ import annotations

import math
import random
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

SCENE_MESHES = Path(__file__).resolve().parents[3] / "build" / "meshes"

Point = tuple[float, float, float]


@dataclass(frozen=True)
class HitMesh:
    """The text of an OBJ file, and points inside the mesh."""

    obj: str
    inside: Sequence[Point]

    def write(self, folder: Path, name: str) -> tuple[Path, Path]:
        """The files that hits.c takes."""
        mesh, inside = folder / f"{name}.obj", folder / f"{name}.txt"
        mesh.write_text(self.obj)
        inside.write_text("".join(f"{x!r} {y!r} {z!r}\n" for x, y, z in self.inside))
        return mesh, inside


def hit_meshes() -> dict[str, HitMesh]:
    """By name: the knot, ball and cube of the scenes, and three made here."""
    near_zero = cloud(0.3, 50)
    return {
        "knot": HitMesh(scene_mesh("knot-100k"), knot_inside()),
        "ball": HitMesh(scene_mesh("ball"), near_zero),
        "cube": HitMesh(scene_mesh("cube"), near_zero),
        "terrain": HitMesh(terrain(160), []),
        "slivers": HitMesh(slivers(500), cloud(0.3, 50)),
        "boulder": HitMesh(boulder(40), cloud(0.2, 50)),
    }


def cloud(radius: float, count: int) -> list[Point]:
    """Points about the origin; the first is the origin itself."""
    rng = random.Random(7)
    inside = [(0.0, 0.0, 0.0)]
    while len(inside) < count:
        p = (rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1))
        if math.hypot(*p) <= 1:
            inside.append((radius * p[0], radius * p[1], radius * p[2]))
    return inside


def scene_mesh(name: str) -> str:
    """A mesh that the scenes use."""
    path = SCENE_MESHES / f"{name}.obj"
    assert path.is_file(), f"{path} is not there: run `make render` or `make test`"
    return path.read_text()


def knot_inside() -> list[Point]:
    """The axis of the knot's tube (a torus knot), which is inside whatever its flutes are."""
    inside = []
    for i in range(40):
        t = 2 * math.pi * i / 40
        r = 1 + 0.46 * math.cos(3 * t)
        inside.append((r * math.cos(2 * t), r * math.sin(2 * t), 0.46 * math.sin(3 * t)))
    return inside


def text(points: Sequence[Point], faces: Sequence[Sequence[int]]) -> str:
    """An OBJ file; faces count from 0."""
    lines = [f"v {x:.9g} {y:.9g} {z:.9g}\n" for x, y, z in points]
    lines += [f"f {' '.join(str(i + 1) for i in face)}\n" for face in faces]
    return "".join(lines)


def terrain(n: int) -> str:
    """An open height field of 2 n n triangles, with flat lands that rays can run along."""
    points = []
    for i in range(n + 1):
        for j in range(n + 1):
            x, z = i / n * 8 - 4, j / n * 8 - 4
            y = 0.4 * math.sin(2 * x) * math.cos(3 * z) + 0.1 * math.sin(11 * x + 7 * z)
            points.append((x, max(y, 0.0), z))
    faces = []
    for i in range(n):
        for j in range(n):
            a, b = i * (n + 1) + j, (i + 1) * (n + 1) + j
            faces += [[a, b, b + 1], [a, b + 1, a + 1]]
    return text(points, faces)


def slivers(n: int) -> str:
    """A closed spindle of 4 n triangles: thin ones up to a needle of 1 : 2000, fans of n around
    both poles, and n without area that lie on edges."""
    points: list[Point] = [(0.0, 4.0, 0.0), (0.0, -4.0, 0.0)]
    rng = random.Random(11)
    angles = sorted(rng.uniform(0, 2 * math.pi) for _ in range(n))
    for a in angles:
        points.append((math.cos(a), 0.5, math.sin(a)))
        points.append((math.cos(a), -0.5, math.sin(a)))
    faces = []
    for i in range(n):
        a, b = 2 + 2 * i, 2 + 2 * ((i + 1) % n)
        faces += [[0, b, a], [1, a + 1, b + 1], [a, b, b + 1, a + 1], [a, b, a]]
    return text(points, faces)


def boulder(n: int) -> str:
    """A closed lump of about 2 n n triangles whose corners are in irregular places, so that their
    sizes differ by a thousand."""
    rng = random.Random(13)
    points: list[Point] = [(0.0, 1.1, 0.0), (0.0, -0.9, 0.0)]
    latitudes = sorted(rng.uniform(-1.4, 1.4) for _ in range(n))
    longitudes = [
        [2 * math.pi * (j + rng.uniform(0, 0.95)) / n for j in range(n)] for _ in latitudes
    ]
    for latitude, ring in zip(latitudes, longitudes, strict=True):
        for longitude in ring:
            r = 1 + 0.05 * rng.uniform(-1, 1)
            points.append((
                r * math.cos(latitude) * math.cos(longitude),
                r * math.sin(latitude),
                r * math.cos(latitude) * math.sin(longitude),
            ))  # fmt: skip
    faces = []
    for j in range(n):
        k = (j + 1) % n
        faces += [[1, 2 + j, 2 + k], [0, 2 + (n - 1) * n + k, 2 + (n - 1) * n + j]]
        for i in range(n - 1):
            a, b = 2 + i * n, 2 + (i + 1) * n
            faces += [[a + j, b + j, b + k], [a + j, b + k, a + k]]
    return text(points, faces)
