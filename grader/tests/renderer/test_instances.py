"""A mesh that several objects show is kept once, and looks as if each had a copy of its own.

All accelerators but `wide` move copies, so their pictures say what must come out.
"""

from __future__ import annotations

import json
import random
from pathlib import Path

import numpy as np
import pytest
from large_mesh import OWN_MEMORY
from renderer_runs import ROOT, Json, diffuse, mesh, point_light, read_exr, run, sphere, write_scene

BALL = str(ROOT / "build" / "meshes" / "ball.obj")
KNOT = str(ROOT / "build" / "meshes" / "knot-100k.obj")
AOVS = ("--aov", "albedo,normal,depth,uv")


def placement(rng: random.Random, spread: float) -> list[float]:
    """Turned and stretched in all directions, mirrored every second time, and moved."""
    w, x, y, z = (rng.gauss(0, 1) for _ in range(4))
    k = 2 / (w * w + x * x + y * y + z * z)
    turn = (
        (1 - k * (y * y + z * z), k * (x * y - z * w), k * (x * z + y * w)),
        (k * (x * y + z * w), 1 - k * (x * x + z * z), k * (y * z - x * w)),
        (k * (x * z - y * w), k * (y * z + x * w), 1 - k * (x * x + y * y)),
    )
    sizes = [rng.choice((-1, 1)) * rng.uniform(0.3, 1.0) for _ in range(3)]
    rows: list[float] = []
    for row in turn:
        rows += [a * s for a, s in zip(row, sizes, strict=True)]
        rows.append(rng.uniform(-spread, spread))
    return [*rows, 0, 0, 0, 1]


def crowd(path: str, count: int, **more: object) -> Json:
    """So many placements of a mesh, lit by a point and by a placement that glows."""
    rng = random.Random(3)
    spread = 1.2 * count ** (1 / 3)
    glow = {"type": "area", "radiance": [4.0, 3.0, 2.0]}
    objects = [mesh(path, "clay", transform=placement(rng, spread)) for _ in range(count)]
    objects.insert(1, sphere((0, 0, 0), 0.6, "clay"))
    objects.insert(2, mesh(BALL, "clay", translate=[0.0, spread + 1.5, 0.0], light=glow))
    scene: Json = {
        "integrator": {"type": "path", "spp": 2, "max_depth": 3},
        "film": {"resolution": [64, 48]},
        "camera": {"position": [0, 0, 4 * spread], "look_at": [0, 0, 0], "fov": 40},
        "lights": [point_light((spread, spread, 2 * spread), (300.0, 300.0, 300.0))],
        "objects": objects,
        **diffuse(clay=(0.7, 0.5, 0.4)),
    }
    return {**scene, **more}


def pictures(folder: Path, scene: Json, *arguments: str) -> tuple[Json, Json, list[np.ndarray]]:
    """What `wide` and `bvh` draw of a scene, all channels, and what they say about it."""
    path = write_scene(folder, scene)
    stats, images = [], []
    for accel in ("wide", "bvh"):
        out = folder / f"{accel}.exr"
        say = folder / f"{accel}.json"
        done = run(path, "-o", out, "--accel", accel, "--stats", say, *arguments, cwd=folder)
        assert done.returncode == 0, done.stderr
        stats.append(json.loads(say.read_text()))
        images.append(read_exr(out).pixels)
    return stats[0], stats[1], images


@pytest.mark.parametrize(("path", "count"), [(BALL, 30), (KNOT, 4)])
def test_instances_look_like_copies(tmp_path: Path, path: str, count: int) -> None:
    wide, bvh, (placed, copied) = pictures(tmp_path, crowd(path, count), *AOVS)
    assert wide["primitives"] == bvh["primitives"]
    assert wide["rays"] == bvh["rays"]
    assert placed.any(axis=-1).mean() > 0.1
    assert np.array_equal(placed, copied)


def test_normals_and_texture_coordinates_are_those_of_copies(tmp_path: Path) -> None:
    for integrator in ("normal", "uv", "depth"):
        _, _, (placed, copied) = pictures(tmp_path, crowd(KNOT, 3), "--integrator", integrator)
        assert placed.any()
        assert np.array_equal(placed, copied)


def test_a_hundred_million_triangles_need_little_memory(tmp_path: Path) -> None:
    path = write_scene(tmp_path, crowd(KNOT, 1000))
    say = tmp_path / "stats.json"
    done = run(path, "-o", "o.exr", "--spp", "1", "--stats", say, cwd=tmp_path, wrapper=OWN_MEMORY)
    assert done.returncode == 0, done.stderr
    stats = json.loads(say.read_text())
    assert stats["primitives"] == 1000 * 100_000 + 1 + 1280
    assert stats["peak_memory_bytes"] < 60e6


def test_places_too_uneven_or_too_far_away_get_copies(tmp_path: Path) -> None:
    """Beams would be useless there; the picture is the same."""
    scene = crowd(BALL, 6)
    scene["objects"][3]["transform"] = [1e-4, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 0, 0, 1]
    scene["objects"][4]["translate"] = [0.0, 0.0, -3e6]
    _, _, (placed, copied) = pictures(tmp_path, scene)
    assert np.array_equal(placed, copied)


def test_a_place_out_of_range_is_refused_by_name(tmp_path: Path) -> None:
    scene = crowd(BALL, 3)
    scene["objects"][3]["transform"] = [3e38, 0, 0, 3e38, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]
    path = write_scene(tmp_path, scene)
    done = run(path, "-o", "o.exr", cwd=tmp_path)
    assert done.returncode == 2
    assert "/objects/3: the transform moves vertex " in done.stderr
