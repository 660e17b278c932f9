"""Write the meshes of the demo and test scenes as Wavefront OBJ files.

    python3 scenes/make_meshes.py build/meshes

Needs only Python 3.11's standard library. Everything is computed from formulas and fixed seeds
and written with a fixed number of digits, so the files are the same on every machine. A file is
complete or absent; if the scripts have not changed since the last run and all files are there,
nothing is written.

Right-handed, y up, metres; faces are counter-clockwise seen from outside.
"""

from __future__ import annotations

import math
import random
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path

import forest
import terrain
from generated import Maker, command
from image_files import png

Vec = tuple[float, float, float]
Corner = tuple[int, ...]
"""Indices, from 0, of a corner's (position, uv, normal), its (position, uv), or its position."""


@dataclass
class Mesh:
    """What goes into one OBJ file; a face is a list of at least three corners."""

    title: str
    positions: list[Vec] = field(default_factory=list)
    uvs: list[tuple[float, float]] = field(default_factory=list)
    normals: list[Vec] = field(default_factory=list)
    faces: list[list[Corner]] = field(default_factory=list)

    def add_polygon(self, points: Sequence[Vec]) -> None:
        """One flat face with corners of its own, given counter-clockwise."""
        first = len(self.positions)
        self.positions.extend(points)
        self.faces.append([(first + i,) for i in range(len(points))])


# Vectors ---------------------------------------------------------------------------------------


def add(a: Vec, b: Vec) -> Vec:
    """a + b"""
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def subtract(a: Vec, b: Vec) -> Vec:
    """a - b"""
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def scale(a: Vec, k: float) -> Vec:
    """k a"""
    return (a[0] * k, a[1] * k, a[2] * k)


def cross(a: Vec, b: Vec) -> Vec:
    """a x b"""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def normalize(a: Vec) -> Vec:
    """a / |a|; a must not be zero."""
    return scale(a, 1.0 / math.sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]))


# The Cornell box -------------------------------------------------------------------------------
#
# Measured by Cornell's Program of Computer Graphics, in millimetres; here one unit is half the
# box's width, x runs to the viewer's right, z towards the viewer, and the floor is y = 0.

CORNELL_WIDTH, CORNELL_HEIGHT, CORNELL_DEPTH = 556.0, 548.8, 559.2


def cornell(x: float, y: float, z: float) -> Vec:
    """The place of a point of Cornell's table."""
    half = CORNELL_WIDTH / 2
    return ((half - x) / half, y / half, (CORNELL_DEPTH / 2 - z) / half)


def cornell_room() -> Mesh:
    """Floor, ceiling and back wall: three quads that face inwards."""
    w, h, d = CORNELL_WIDTH, CORNELL_HEIGHT, CORNELL_DEPTH
    mesh = Mesh("Cornell box: floor, ceiling, back wall")
    mesh.add_polygon([cornell(w, 0, 0), cornell(0, 0, 0), cornell(0, 0, d), cornell(w, 0, d)])
    mesh.add_polygon([cornell(w, h, 0), cornell(w, h, d), cornell(0, h, d), cornell(0, h, 0)])
    mesh.add_polygon([cornell(w, 0, d), cornell(0, 0, d), cornell(0, h, d), cornell(w, h, d)])
    return mesh


def cornell_left() -> Mesh:
    """The red wall, as two triangles."""
    w, h, d = CORNELL_WIDTH, CORNELL_HEIGHT, CORNELL_DEPTH
    mesh = Mesh("Cornell box: left wall")
    mesh.add_polygon([cornell(w, 0, 0), cornell(w, 0, d), cornell(w, h, d)])
    mesh.add_polygon([cornell(w, 0, 0), cornell(w, h, d), cornell(w, h, 0)])
    return mesh


def cornell_right() -> Mesh:
    """The green wall, as two triangles."""
    h, d = CORNELL_HEIGHT, CORNELL_DEPTH
    mesh = Mesh("Cornell box: right wall")
    mesh.add_polygon([cornell(0, 0, d), cornell(0, 0, 0), cornell(0, h, 0)])
    mesh.add_polygon([cornell(0, 0, d), cornell(0, h, 0), cornell(0, h, d)])
    return mesh


def cornell_block(title: str, height: float, base: Sequence[tuple[float, float]]) -> Mesh:
    """A block on the floor; base has its four (x, z), counter-clockwise seen from above."""
    mesh = Mesh(title)
    low = [cornell(x, 0, z) for x, z in base]
    high = [cornell(x, height, z) for x, z in base]
    mesh.add_polygon(high)
    for i, j in ((0, 1), (1, 2), (2, 3), (3, 0)):
        mesh.add_polygon([low[i], low[j], high[j], high[i]])
    return mesh


def cornell_short_block() -> Mesh:
    """The cube at the front right."""
    base = [(130, 65), (82, 225), (240, 272), (290, 114)]
    return cornell_block("Cornell box: short block", 165, base)


def cornell_tall_block() -> Mesh:
    """The tall block at the back left."""
    base = [(423, 247), (265, 296), (314, 456), (472, 406)]
    return cornell_block("Cornell box: tall block", 330, base)


def cornell_lamp() -> Mesh:
    """The lamp's plate: one quad just under the ceiling, facing down."""
    y = CORNELL_HEIGHT - 0.2
    mesh = Mesh("Cornell box: lamp plate")
    mesh.add_polygon(
        [cornell(x, y, z) for x, z in ((343, 227), (343, 332), (213, 332), (213, 227))]
    )
    return mesh


# Small meshes for tests ------------------------------------------------------------------------


def cube() -> Mesh:
    """The cube [-1, 1]^3: six quads with normals and texture coordinates."""
    mesh = Mesh("Cube")
    mesh.uvs = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
    for axis in range(3):
        for side in (1.0, -1.0):
            normal = tuple(side if i == axis else 0.0 for i in range(3))
            first = len(mesh.positions)
            for a, b in ((-side, -1.0), (side, -1.0), (side, 1.0), (-side, 1.0)):
                point = {axis: side, (axis + 1) % 3: a, (axis + 2) % 3: b}
                mesh.positions.append((point[0], point[1], point[2]))
            mesh.faces.append([(first + i, i, len(mesh.normals)) for i in range(4)])
            mesh.normals.append((normal[0], normal[1], normal[2]))
    return mesh


def ball() -> Mesh:
    """A unit sphere of 1280 triangles: an icosahedron, three times split, with its normals."""
    mesh = Mesh("Ball")
    golden = (1 + math.sqrt(5)) / 2
    for a in (1.0, -1.0):
        for b in (golden, -golden):
            mesh.positions += [(0.0, a, b), (a, b, 0.0), (b, 0.0, a)]
    edge = 4.0
    triangles = [
        (i, j, k)
        for i in range(12)
        for j in range(i + 1, 12)
        for k in range(j + 1, 12)
        if all(
            abs(math.dist(mesh.positions[p], mesh.positions[q]) ** 2 - edge) < 1e-9
            for p, q in ((i, j), (j, k), (k, i))
        )
    ]
    mesh.positions = [normalize(p) for p in mesh.positions]
    triangles = [outwards(mesh.positions, t) for t in triangles]
    for _ in range(3):
        triangles = split_on_sphere(mesh.positions, triangles)
    mesh.normals = list(mesh.positions)
    mesh.faces = [[(i, -1, i) for i in triangle] for triangle in triangles]
    return mesh


def outwards(points: Sequence[Vec], triangle: tuple[int, int, int]) -> tuple[int, int, int]:
    """The triangle, turned so that its normal points away from the origin."""
    i, j, k = triangle
    normal = cross(subtract(points[j], points[i]), subtract(points[k], points[i]))
    facing = sum(n * p for n, p in zip(normal, points[i], strict=True))
    return (i, j, k) if facing > 0 else (i, k, j)


def split_on_sphere(
    points: list[Vec], triangles: Iterable[tuple[int, int, int]]
) -> list[tuple[int, int, int]]:
    """Each triangle in four; the new points, shared along edges, are pushed onto the sphere."""
    middles: dict[tuple[int, int], int] = {}

    def middle(i: int, j: int) -> int:
        key = (min(i, j), max(i, j))
        if key not in middles:
            middles[key] = len(points)
            points.append(normalize(add(points[i], points[j])))
        return middles[key]

    result = []
    for i, j, k in triangles:
        a, b, c = middle(i, j), middle(j, k), middle(k, i)
        result += [(i, a, c), (a, j, b), (c, b, k), (a, b, c)]
    return result


def flawed_ball() -> Mesh:
    """The ball with what exports from modellers contain: faces twice, and faces without area.

    It must look just like the ball without normals.
    """
    mesh = ball()
    mesh.title = "Ball with duplicate and zero-area faces"
    mesh.normals = []
    sound = [[(corner[0],) for corner in face] for face in mesh.faces]
    mesh.faces = []
    for number, (a, b, c) in enumerate(sound):
        mesh.faces.append([a, b, c])
        if number % 3 == 0:
            mesh.faces.append([b, c, a])  # the same triangle again
        if number % 5 == 0:
            mesh.faces += [[a, a, b], [c, c, c]]  # an edge and a point
        if number % 7 == 0:
            ends = (mesh.positions[a[0]], mesh.positions[b[0]])
            mesh.faces.append([a, b, (len(mesh.positions),)])  # three points in a row
            mesh.positions.append(scale(add(*ends), 0.5))
    return mesh


def blocks() -> Mesh:
    """A floor and sixteen blocks of whole-numbered corners: every plane is shared by many boxes."""
    mesh = Mesh("Blocks on whole numbers")
    mesh.add_polygon([(-4.0, 0.0, 4.0), (4.0, 0.0, 4.0), (4.0, 0.0, -4.0), (-4.0, 0.0, -4.0)])
    for i in range(4):
        for k in range(4):
            add_block(mesh, 2.0 * i - 4.0, 2.0 * k - 4.0, float((i * 3 + k * 2) % 4))
    return mesh


def add_block(mesh: Mesh, x: float, z: float, height: float) -> None:
    """A block without floor on [x, x + 1] x [z, z + 1]; nothing if it has no height."""
    if height == 0.0:
        return
    corners = [(x, z + 1), (x + 1, z + 1), (x + 1, z), (x, z)]
    mesh.add_polygon([(a, height, b) for a, b in corners])
    for (a, b), (c, d) in zip(corners, corners[1:] + corners[:1], strict=True):
        mesh.add_polygon([(a, 0.0, b), (c, 0.0, d), (c, height, d), (a, height, b)])


# The studio ------------------------------------------------------------------------------------


def backdrop() -> Mesh:
    """A photographer's backdrop: a floor y = 0 that curves up into a wall, 60 m wide.

    The floor comes from z = 30 and bends between z = -6 and z = -14 on a quarter circle; the
    wall ends at y = 34. Smooth normals; texture coordinates count metres.
    """
    half_width, radius, bend, steps = 30.0, 8.0, -6.0, 48
    profile = [(0.0, 30.0, 1.0, 0.0)]  # y, z, and the normal's y and z
    for i in range(steps + 1):
        a = math.pi / 2 * i / steps
        y, z = radius * (1 - math.cos(a)), bend - radius * math.sin(a)
        profile.append((y, z, math.cos(a), math.sin(a)))
    profile.append((34.0, bend - radius, 0.0, 1.0))
    mesh = Mesh("Backdrop")
    along = 0.0
    for i, (y, z, ny, nz) in enumerate(profile):
        along += math.dist((y, z), profile[i - 1][:2]) if i > 0 else 0.0
        mesh.positions += [(-half_width, y, z), (half_width, y, z)]
        mesh.uvs += [(0.0, along), (2 * half_width, along)]
        mesh.normals.append((0.0, ny, nz))
    for i in range(len(profile) - 1):
        corners = ((2 * i, i), (2 * i + 1, i), (2 * i + 3, i + 1), (2 * i + 2, i + 1))
        mesh.faces.append([(p, p, n) for p, n in corners])
    return mesh


# The knot --------------------------------------------------------------------------------------

KNOT_ALONG, KNOT_AROUND = 500, 100
KNOT_TURNS, KNOT_COILS = 2, 3
KNOT_MAJOR, KNOT_MINOR, KNOT_TUBE = 1.0, 0.46, 0.24


def knot_100k() -> Mesh:
    """A trefoil tube of exactly 100,000 triangles, fluted and gently swollen by seeded waves.

    The axis is a (2, 3) torus knot around +z, about 3.4 wide; u runs along it, v around it.
    """
    mesh = Mesh("Torus knot, 100,000 triangles")
    waves = knot_waves(random.Random(1976))
    for i in range(KNOT_ALONG):
        t = 2 * math.pi * i / KNOT_ALONG
        centre, across, out = knot_frame(t)
        for j in range(KNOT_AROUND):
            s = 2 * math.pi * j / KNOT_AROUND
            radius = KNOT_TUBE * (1 + sum(a * math.cos(n * t + m * s + p) for a, n, m, p in waves))
            ring = add(scale(out, radius * math.cos(s)), scale(across, radius * math.sin(s)))
            mesh.positions.append(add(centre, ring))
    mesh.normals = knot_normals(mesh.positions)
    mesh.uvs = [
        (i / KNOT_ALONG, j / KNOT_AROUND)
        for i in range(KNOT_ALONG + 1)
        for j in range(KNOT_AROUND + 1)
    ]
    for i in range(KNOT_ALONG):
        for j in range(KNOT_AROUND):
            a, b, c, d = (knot_corner(i + k, j + m) for k, m in ((0, 0), (1, 0), (1, 1), (0, 1)))
            mesh.faces += [[a, b, c], [a, c, d]]
    return mesh


def knot_waves(rng: random.Random) -> list[tuple[float, int, int, float]]:
    """Amplitude, waves along, waves around, phase. Whole numbers close the surface smoothly.

    The five flutes follow the diagonals of the grid, along which its triangles are split: their
    shadows' edges stay smooth.
    """
    flutes = (0.13, -5 * KNOT_ALONG // KNOT_AROUND, 5, 0.0)
    swell = [(0.07 / k, k * KNOT_COILS, 0, rng.uniform(0, 2 * math.pi)) for k in (1, 2)]
    lumps = [
        (0.02, rng.randint(-30, 30), rng.randint(1, 3), rng.uniform(0, 2 * math.pi))
        for _ in range(5)
    ]
    return [flutes, *swell, *lumps]


def knot_axis(t: float) -> Vec:
    """The (2, 3) torus knot at t in [0, 2 pi]."""
    r = KNOT_MAJOR + KNOT_MINOR * math.cos(KNOT_COILS * t)
    x, y = r * math.cos(KNOT_TURNS * t), r * math.sin(KNOT_TURNS * t)
    return (x, y, KNOT_MINOR * math.sin(KNOT_COILS * t))


def knot_frame(t: float) -> tuple[Vec, Vec, Vec]:
    """Point of the axis, and two unit vectors at right angles to it and to each other.

    "out" is the normal of the torus that the knot winds on: a frame that closes by itself.
    """
    centre = knot_axis(t)
    tangent = normalize(subtract(knot_axis(t + 1e-4), knot_axis(t - 1e-4)))
    hub = (KNOT_MAJOR * math.cos(KNOT_TURNS * t), KNOT_MAJOR * math.sin(KNOT_TURNS * t), 0.0)
    across = normalize(cross(subtract(centre, hub), tangent))
    return centre, across, cross(tangent, across)


def knot_normals(positions: Sequence[Vec]) -> list[Vec]:
    """The cross product of the differences of each point's neighbours."""
    normals = []
    for i in range(KNOT_ALONG):
        before, after = (i - 1) % KNOT_ALONG, (i + 1) % KNOT_ALONG
        for j in range(KNOT_AROUND):
            left, right = (j - 1) % KNOT_AROUND, (j + 1) % KNOT_AROUND
            row = i * KNOT_AROUND
            around = subtract(positions[row + right], positions[row + left])
            along = subtract(
                positions[after * KNOT_AROUND + j], positions[before * KNOT_AROUND + j]
            )
            normals.append(normalize(cross(along, around)))
    return normals


def knot_corner(i: int, j: int) -> Corner:
    """Corner (i, j) of the grid; positions and normals wrap around, texture coordinates end."""
    point = i % KNOT_ALONG * KNOT_AROUND + j % KNOT_AROUND
    return (point, i * (KNOT_AROUND + 1) + j, point)


# Output ----------------------------------------------------------------------------------------

MESHES: dict[str, Callable[[], Mesh]] = {
    "cbox-room.obj": cornell_room,
    "cbox-left.obj": cornell_left,
    "cbox-right.obj": cornell_right,
    "cbox-short-block.obj": cornell_short_block,
    "cbox-tall-block.obj": cornell_tall_block,
    "cbox-lamp.obj": cornell_lamp,
    "cube.obj": cube,
    "ball.obj": ball,
    "flawed-ball.obj": flawed_ball,
    "blocks.obj": blocks,
    "backdrop.obj": backdrop,
    "knot-100k.obj": knot_100k,
}


def obj_number(x: float) -> str:
    """Six decimals, trailing zeros dropped, no negative zero."""
    text = f"{x:.6f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def obj_line(key: str, values: Iterable[float]) -> str:
    """A line such as "v 1 0.5 0"."""
    return f"{key} {' '.join(map(obj_number, values))}\n"


def obj_corner(corner: Corner) -> str:
    """A corner in OBJ's notation, counted from 1; an index below 0 is left out."""
    return "/".join(str(i + 1) if i >= 0 else "" for i in corner)


def obj_lines(mesh: Mesh) -> Iterator[str]:
    """The whole file."""
    yield f"# {mesh.title}; written by scenes/make_meshes.py\n"
    yield from (obj_line("v", p) for p in mesh.positions)
    yield from (obj_line("vt", t) for t in mesh.uvs)
    yield from (obj_line("vn", n) for n in mesh.normals)
    yield from (f"f {' '.join(map(obj_corner, face))}\n" for face in mesh.faces)


def obj_file(build: Callable[[], Mesh]) -> Iterator[bytes]:
    """The bytes of the mesh that "build" makes."""
    return (line.encode("ascii") for line in obj_lines(build()))


def terrain_mesh() -> Iterator[bytes]:
    """A million triangles: see terrain.py."""
    return (line.encode("ascii") for line in terrain.obj_lines())


def terrain_colors() -> Iterator[bytes]:
    """The terrain's texture."""
    return png(list(terrain.color_rows()))


def forest_tree(name: str) -> Iterator[bytes]:
    """One of the forest's trees: see forest.py."""
    return (line.encode("ascii") for line in forest.tree_lines(forest.TREES[name]))


def forest_leaves(name: str) -> Iterator[bytes]:
    """The colours of a tree."""
    return png(forest.palette_rows(name))


def forest_ground() -> Iterator[bytes]:
    """What the trees stand on."""
    return (line.encode("ascii") for line in forest.ground_lines())


FILES: dict[str, Maker] = {
    "terrain.obj": terrain_mesh,
    "terrain.png": terrain_colors,
    "forest-ground.obj": forest_ground,
    **{name: partial(forest_tree, name) for name in forest.TREES},
    **{name: partial(forest_leaves, name) for name in forest.PALETTES},
    **{name: partial(obj_file, build) for name, build in MESHES.items()},
}

HERE = Path(__file__).parent
SOURCES = [
    HERE / f"{name}.py"
    for name in ("make_meshes", "forest", "generated", "image_files", "noise", "terrain")
]

if __name__ == "__main__":
    sys.exit(command("make_meshes.py", FILES, SOURCES, sys.argv[1:]))
