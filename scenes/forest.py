"""An autumn forest: two trees, shown seven hundred times, on a ground of gentle hills.

    python3 scenes/forest.py > scenes/forest.json

writes the scene; make_meshes.py makes the trees, the ground and the colours. Metres; y is up.

A tree is grown by recursion: a branch carries smaller branches, set about it by the golden angle
as many plants do, and the last ones carry leaves. H. Honda, "Description of the Form of Trees by
the Parameters of the Tree-Like Body", Journal of Theoretical Biology 31(2), 1971.
"""

from __future__ import annotations

import json
import math
import random
import sys
from collections.abc import Iterator
from dataclasses import dataclass, field

Vec = tuple[float, float, float]
Color = tuple[float, float, float]

GOLDEN_ANGLE = math.pi * (3 - math.sqrt(5))


def step(a: Vec, k: float, b: Vec) -> Vec:
    """a + k b"""
    return (a[0] + k * b[0], a[1] + k * b[1], a[2] + k * b[2])


def cross(a: Vec, b: Vec) -> Vec:
    """a x b"""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def normalize(a: Vec) -> Vec:
    """a / |a|; a must not be zero."""
    k = 1.0 / math.sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2])
    return (a[0] * k, a[1] * k, a[2] * k)


def sides(axis: Vec) -> tuple[Vec, Vec]:
    """Two unit vectors at right angles to an axis of length one and to each other."""
    other = (1.0, 0.0, 0.0) if abs(axis[0]) < 0.7 else (0.0, 0.0, 1.0)
    across = normalize(cross(axis, other))
    return across, cross(axis, across)


# Trees -----------------------------------------------------------------------------------------

SHADES = 32
"""Columns of the texture: leaves differ in colour. Its upper row is for leaves, the lower bark."""


@dataclass(frozen=True)
class Kind:
    """What makes one tree unlike another."""

    title: str
    seed: int
    trunk: float
    """Length and, below, thickness of the first branch."""
    thickness: float
    branches: tuple[int, ...]
    """How many each branch carries, level by level."""
    tilt: float
    """Radians between a branch and what it carries."""
    shorter: float
    leaves: int
    """On a last branch, ..."""
    leaf: float
    """... and their length."""


TREES = {
    "tree-round.obj": Kind("Round tree", 4, 2.3, 0.17, (5, 5, 4, 4), 0.72, 0.66, 22, 0.21),
    "tree-slender.obj": Kind("Slender tree", 9, 3.3, 0.12, (6, 5, 4, 4), 0.47, 0.60, 18, 0.17),
}


@dataclass
class Tree:
    """A tree as it grows: the lines of its OBJ file."""

    kind: Kind
    rng: random.Random
    points: list[Vec] = field(default_factory=list)
    faces: list[str] = field(default_factory=list)

    def face(self, shade: int, *corners: int) -> None:
        """Corners count from 0; the shade is the number of a texture coordinate."""
        self.faces.append(f"f {' '.join(f'{i + 1}/{shade + 1}' for i in corners)}\n")

    def tube(self, start: Vec, end: Vec, axis: Vec, radii: tuple[float, float]) -> None:
        """Six sides, open at both ends, which are hidden."""
        first, across, up = len(self.points), *sides(axis)
        for centre, radius in zip((start, end), radii, strict=True):
            for i in range(6):
                a = i * math.pi / 3
                rim = step(centre, radius * math.cos(a), across)
                self.points.append(step(rim, radius * math.sin(a), up))
        for i in range(6):
            k = (i + 1) % 6
            self.face(SHADES, first + i, first + k, first + 6 + k, first + 6 + i)

    def leaf(self, at: Vec) -> None:
        """Folded along its middle and closed below: four triangles, seen from all sides."""
        rng, first = self.rng, len(self.points)
        length = self.kind.leaf * rng.uniform(0.7, 1.2)
        along = normalize((rng.gauss(0, 1), rng.gauss(-0.4, 0.8), rng.gauss(0, 1)))
        across, up = sides(along)
        middle = step(step(at, 0.5 * length, along), 0.1 * length, up)
        wide = 0.36 * length
        self.points += [at, step(at, length, along)]
        self.points += [step(middle, wide, across), step(middle, -wide, across)]
        shade = rng.randrange(SHADES)
        for a, b, c in ((0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)):
            self.face(shade, first + a, first + b, first + c)

    def grow(self, start: Vec, axis: Vec, length: float, radius: float, level: int) -> None:
        """A branch and all that it carries."""
        kind, rng = self.kind, self.rng
        end = step(start, length, axis)
        self.tube(start, end, axis, (radius, 0.62 * radius))
        if level == len(kind.branches):
            for _ in range(kind.leaves):
                around = (rng.gauss(0, 1), rng.gauss(0, 1), rng.gauss(0, 1))
                along = step(start, rng.uniform(0.2, 1.2) * length, axis)
                self.leaf(step(along, 0.42 * kind.leaf, around))
            return
        across, up = sides(axis)
        turn = rng.uniform(0, 2 * math.pi)
        count = kind.branches[level]
        for i in range(count):
            a = turn + i * GOLDEN_ANGLE
            out = step(step((0, 0, 0), math.cos(a), across), math.sin(a), up)
            tilt = kind.tilt * rng.uniform(0.6, 1.25) * (0.35 if i == count - 1 else 1.0)
            way = step(step((0, 0, 0), math.cos(tilt), axis), math.sin(tilt), out)
            way = normalize(step(way, 0.16, (0.0, 1.0, 0.0)))
            place = 1.0 if i == count - 1 else rng.uniform(0.55, 0.98)
            thinner = radius * (0.6 if i == count - 1 else 0.45)
            longer = length * kind.shorter * rng.uniform(0.8, 1.15)
            self.grow(step(start, place * length, axis), way, longer, thinner, level + 1)


def tree_lines(kind: Kind) -> Iterator[str]:
    """The OBJ file of a tree that stands at the origin."""
    tree = Tree(kind, random.Random(kind.seed))
    tree.grow((0.0, -0.2, 0.0), (0.0, 1.0, 0.0), kind.trunk, kind.thickness, 0)
    yield f"# {kind.title}; written by scenes/make_meshes.py\n"
    yield from (f"v {x:.3f} {y:.3f} {z:.3f}\n" for x, y, z in tree.points)
    yield from (f"vt {(i + 0.5) / SHADES:.5f} 0.75\n" for i in range(SHADES))
    yield "vt 0.5 0.25\n"
    yield from tree.faces


PALETTES: dict[str, tuple[Color, Color]] = {
    "leaves-gold.png": ((0.56, 0.30, 0.02), (0.66, 0.46, 0.05)),
    "leaves-rust.png": ((0.36, 0.055, 0.02), (0.60, 0.19, 0.03)),
    "leaves-green.png": ((0.10, 0.17, 0.025), (0.30, 0.30, 0.04)),
}
"""Leaves are of all colours between two."""
BARK = (0.17, 0.13, 0.10)


def palette_rows(name: str) -> list[list[Color]]:
    """A texel for each shade, and bark below."""
    low, high = PALETTES[name]
    shades = [
        (
            low[0] + (high[0] - low[0]) * i / (SHADES - 1),
            low[1] + (high[1] - low[1]) * i / (SHADES - 1),
            low[2] + (high[2] - low[2]) * i / (SHADES - 1),
        )
        for i in range(SHADES)
    ]
    return [shades, [BARK] * SHADES]


# The ground ------------------------------------------------------------------------------------

WIDTH, NEAR, FAR, CELL = 220.0, 40.0, -260.0, 1.0


def height(x: float, z: float) -> float:
    """A valley that winds away from the viewer, between hills that rise with distance."""
    away = max(-z, 0.0) / 100.0
    off = x - bend(z)
    slope = 9.0 * (1 - math.exp(-((off / 38.0) ** 2))) * (0.35 + away)
    folds = 0.9 * math.sin(0.11 * x + 0.05 * z) * math.sin(0.07 * z) + 0.25 * math.sin(0.31 * x)
    return slope + folds * min(1.0, abs(off) / 12.0)


def bend(z: float) -> float:
    """Where the valley's bottom is."""
    return 9.0 * math.sin(z / 34.0)


def ground_lines() -> Iterator[str]:
    """The OBJ file: a grid of squares with smooth normals."""
    columns, rows = round(WIDTH / CELL), round((NEAR - FAR) / CELL)
    yield "# Forest ground; written by scenes/make_meshes.py\n"
    places = [
        (i * CELL - WIDTH / 2, NEAR - j * CELL) for j in range(rows + 1) for i in range(columns + 1)
    ]
    yield from (f"v {x:.1f} {height(x, z):.3f} {z:.1f}\n" for x, z in places)
    for x, z in places:
        a = height(x - 0.5, z) - height(x + 0.5, z)
        b = height(x, z - 0.5) - height(x, z + 0.5)
        n = normalize((a, 1.0, b))
        yield f"vn {n[0]:.4f} {n[1]:.4f} {n[2]:.4f}\n"
    for j in range(rows):
        for i in range(columns):
            near = j * (columns + 1) + i + 1
            far = near + columns + 1
            corners = (near, near + 1, far + 1, far)
            yield f"f {' '.join(f'{k}//{k}' for k in corners)}\n"


# The scene -------------------------------------------------------------------------------------

SPACING = 5.2
EYE = (3.5, 5.2, 20.0)
TARGET = (0.5, 3.6, -40.0)


def trees() -> Iterator[dict[str, object]]:
    """On a jittered grid, turned and of several sizes, every second one mirrored."""
    rng = random.Random(21)
    for j in range(34):
        for i in range(41):
            x = (i - 20 + rng.uniform(-0.42, 0.42)) * SPACING
            z = 8.0 - (j + rng.uniform(-0.42, 0.42)) * SPACING
            size, turn = rng.uniform(0.75, 1.3), rng.uniform(0, 2 * math.pi)
            name = "slender" if rng.random() < 0.4 else "round"
            color = rng.choices(("gold", "rust", "green"), (5, 3, 3))[0]
            mirror = rng.choice((-1, 1))
            if seen(x, z):
                c, s = size * math.cos(turn), size * math.sin(turn)
                tall = size * rng.uniform(0.9, 1.2)
                rows = [mirror * c, 0, s, x, 0, tall, 0, height(x, z), -mirror * s, 0, c, z]
                yield {
                    "type": "mesh",
                    "path": f"../build/meshes/tree-{name}.obj",
                    "transform": [*(round(a, 2) + 0.0 for a in rows), 0, 0, 0, 1],
                    "material_name": f"leaves-{color}",
                }


def seen(x: float, z: float) -> bool:
    """Is there room for a tree, and does the viewer see it or its shadow?"""
    clearing = abs(x - bend(z)) < 4.5 + 3.0 * math.exp(-((z + 8.0) ** 2) / 300.0)
    return not clearing and abs(x - EYE[0]) < 12.0 + 0.52 * (EYE[2] - z)


def scene_text() -> str:
    """The scene file, an object a line."""
    objects = [
        {"type": "mesh", "path": "../build/meshes/forest-ground.obj", "material_name": "grass"},
        *trees(),
    ]
    leaves = [name.removesuffix(".png") for name in PALETTES]
    scene = {
        "$schema": "scene.schema.json",
        "integrator": {"type": "path", "spp": 32, "max_depth": 4},
        "film": {"resolution": [720, 432]},
        "camera": {"position": EYE, "look_at": TARGET, "fov": 42.0},
        "sampler": {"type": "sobol"},
        "textures": {
            "sky": {"type": "image", "path": "../build/images/sunny-sky.hdr", "filter": "bilinear"},
            "grass": {"type": "constant", "color": [0.16, 0.15, 0.05]},
            **{
                name: {"type": "image", "path": f"../build/meshes/{name}.png", "filter": "nearest"}
                for name in leaves
            },
        },
        "materials": {
            name: {"type": "diffuse", "texture_name": name} for name in ("grass", *leaves)
        },
    }
    sky = {"texture_name": "sky", "transform": [1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1]}
    head = json.dumps(scene, indent=2)[:-2]
    lines = ",\n".join(f"    {json.dumps(item)}" for item in objects)
    return f'{head},\n  "environment_map": {json.dumps(sky)},\n  "objects": [\n{lines}\n  ]\n}}\n'


if __name__ == "__main__":
    sys.stdout.write(scene_text())
