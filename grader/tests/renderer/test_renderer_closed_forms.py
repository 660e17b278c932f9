"""Pictures that can be computed on paper: each pixel against the formula, in double precision."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import numpy.typing as npt
import pytest
from renderer_runs import (
    Json,
    Pixels,
    diffuse,
    mesh,
    point_light,
    render,
    sphere,
    write_mesh,
    write_scene,
)

Array = npt.NDArray[np.float64]

WIDTH, HEIGHT = 48, 40
ALBEDO = np.array([0.8, 0.5, 0.2])
FLUX = np.array([900.0, 700.0, 500.0])
LIGHT = np.array([0.7, 2.0, 0.3])
BLACK_LIGHT = {"type": "intersection_test", "point_light_flux": [0, 0, 0]}

# Larger than all that the cameras below see, in the plane y = 0, facing up.
FLOOR = "v -30 0 30\nv 30 0 30\nv 30 0 -30\nv -30 0 -30\nf 1 2 3 4\n"


def scene_of(objects: Sequence[Json], lights: Sequence[Json], camera: Json) -> Json:
    """Samples are taken next to the pixels' centres, where the formulas are evaluated."""
    return {
        "integrator": {**BLACK_LIGHT, "spp": 2},
        "film": {"resolution": [WIDTH, HEIGHT], "filter": {"type": "box", "radius": 0.001}},
        "camera": camera,
        "objects": list(objects),
        "lights": list(lights),
        **diffuse(paint=ALBEDO.tolist(), other=[0.3, 0.6, 0.9]),
    }


def normalized(v: Array) -> Array:
    return np.asarray(v / np.linalg.norm(v, axis=-1, keepdims=True))


def directions(camera: Json) -> Array:
    """The unit direction through each pixel's centre, by the definition of the scene format."""
    position, target, up = (np.array(camera[k], float) for k in ("position", "look_at", "ref_up"))
    forward = normalized(target - position)
    right = normalized(np.cross(forward, up))
    true_up = np.cross(right, forward)
    half = np.tan(np.radians(camera["fov"]) / 2)
    x = (2 * (np.arange(WIDTH) + 0.5) / WIDTH - 1) * half * WIDTH / HEIGHT
    y = (1 - 2 * (np.arange(HEIGHT) + 0.5) / HEIGHT) * half
    grid = x[None, :, None] * right + y[:, None, None] * true_up
    return normalized(forward + grid)


def lit(points: Array, normals: Array, light: Array = LIGHT, flux: Array = FLUX) -> Array:
    """albedo / pi x flux / (4 pi d^2) x cosine, and nothing from behind."""
    to_light = light - points
    squared = np.sum(to_light**2, axis=-1, keepdims=True)
    cosine = np.sum(to_light * normals, axis=-1, keepdims=True) / np.sqrt(squared)
    return np.asarray(ALBEDO / np.pi * flux / (4 * np.pi * squared) * np.maximum(cosine, 0))


def floor_points(camera: Json) -> Array:
    position, d = np.array(camera["position"], float), directions(camera)
    return np.asarray(position + d * (-position[1] / d[..., 1:2]))


def first_hits(origin: Array, d: Array, center: Array, radius: float) -> Array:
    """t of the nearer crossing of a sphere from outside; NaN where there is none."""
    to_center = center - origin
    b = np.sum(to_center * d, axis=-1)
    square = b**2 - np.sum(to_center**2, axis=-1) + radius**2
    return np.asarray(b - np.sqrt(np.where(square > 0, square, np.nan)))


def expect_close(picture: Pixels, formula: Array, of_value: float, of_peak: float = 0) -> None:
    """Samples lie up to a thousandth of a pixel beside the centre, and a pixel of these pictures
    is about 0.1 m: how much that changes the value is what the two bounds are for."""
    assert np.all(np.isfinite(picture))
    beyond = np.abs(picture - formula) - of_value * formula - of_peak * formula.max()
    assert beyond.max() <= 0, f"off by {beyond.max()} more than {of_value}, {of_peak} allow"


LOOKING_DOWN = {
    "position": [1, 4, 5],
    "look_at": [0.5, 0, 0],
    "ref_up": [0, 1, 0],
    "fov": 40,
}


def test_a_floor_under_a_point_light(tmp_path: Path) -> None:
    write_mesh(tmp_path, "floor.obj", FLOOR)
    light = point_light(LIGHT.tolist(), FLUX.tolist())
    scene = scene_of([mesh("floor.obj", "paint")], [light], LOOKING_DOWN)
    picture = render(write_scene(tmp_path, scene), tmp_path)
    expect_close(picture, lit(floor_points(LOOKING_DOWN), np.array([0.0, 1.0, 0.0])), 3e-4)


def test_a_sphere_under_a_point_light(tmp_path: Path) -> None:
    center, radius = np.array([0.2, 0.1, -0.3]), 1.5
    light = point_light([3, 2, 3], FLUX.tolist())
    scene = scene_of([sphere(center.tolist(), radius, "paint")], [light], LOOKING_DOWN)
    picture = render(write_scene(tmp_path, scene), tmp_path)
    origin, d = np.array(LOOKING_DOWN["position"], float), directions(LOOKING_DOWN)
    t = first_hits(origin, d, center, radius)[..., None]
    normals = (origin + t * d - center) / radius
    formula = np.nan_to_num(lit(origin + t * d, normals, np.array([3.0, 2.0, 3.0])))
    inside = ~np.isnan(t[..., 0])
    steep = np.sum(normals * d, axis=-1) < -0.1  # at the rim a small step is a long way in depth
    assert (inside & steep).mean() > 0.2
    expect_close(picture[inside & steep], formula[inside & steep], 0, 1e-3)
    assert np.count_nonzero(picture[~inside].any(axis=-1)) <= 2, "light outside of the sphere"


def test_the_shadow_of_a_sphere(tmp_path: Path) -> None:
    """Above the camera, so that only its shadow is seen."""
    write_mesh(tmp_path, "floor.obj", FLOOR)
    center, radius, lamp = np.array([0.4, 6.0, 0.2]), 0.5, np.array([0.7, 9.0, 0.3])
    objects = [mesh("floor.obj", "paint"), sphere(center.tolist(), radius, "other")]
    light = point_light(lamp.tolist(), FLUX.tolist())
    picture = render(write_scene(tmp_path, scene_of(objects, [light], LOOKING_DOWN)), tmp_path)
    points = floor_points(LOOKING_DOWN)
    way = normalized(lamp - points)
    along = np.sum((center - points) * way, axis=-1, keepdims=True)
    miss = np.linalg.norm(center - points - along * way, axis=-1)
    dark, bright = miss < radius - 0.01, miss > radius + 0.01
    assert dark.sum() > 100 and bright.sum() > 100
    assert not picture[dark].any(), "light in the shadow"
    formula = lit(points, np.array([0.0, 1.0, 0.0]), lamp)
    expect_close(picture[bright], formula[bright], 3e-4)


def test_lights_add(tmp_path: Path) -> None:
    write_mesh(tmp_path, "floor.obj", FLOOR)
    objects = [mesh("floor.obj", "paint"), sphere([0.5, 0.8, 0.5], 0.8, "other")]
    lights = [
        point_light(LIGHT.tolist(), [10, 20, 30]),
        point_light([-3, 4, 1], [50, 60, 5]),
        point_light([2, 7, 3], [0, 0, 99]),
    ]

    def picture(chosen: Sequence[Json]) -> Pixels:
        return render(write_scene(tmp_path, scene_of(objects, chosen, LOOKING_DOWN)), tmp_path)

    alone = sum(picture([light]).astype(np.float64) for light in lights)
    together = picture(lights)
    assert together.any()
    np.testing.assert_allclose(together, alone, rtol=1e-6, atol=1e-9)


def test_the_integrators_own_light_is_one_of_the_lights(tmp_path: Path) -> None:
    write_mesh(tmp_path, "floor.obj", FLOOR)
    light = point_light(LIGHT.tolist(), FLUX.tolist())
    scene = scene_of([mesh("floor.obj", "paint")], [light], LOOKING_DOWN)
    listed = render(write_scene(tmp_path, scene), tmp_path)
    keys = {
        "point_light_position": LIGHT.tolist(),
        "point_light_flux": FLUX.tolist(),
    }
    own = {**scene, "lights": [], "integrator": {**scene["integrator"], **keys}}
    assert np.array_equal(listed, render(write_scene(tmp_path, own), tmp_path))


# Mirrors ------------------------------------------------------------------------------------------

# A tent without symmetry: each face has its own slope, so a wrong normal shows.
CORNERS = np.array([[-1, 0, 1], [1.5, 0, 0.8], [1, 0, -1], [-1.2, 0, -0.7], [0.3, 1.1, 0.2]])
TENT_FACES = [(0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)]


def tent(mirrored: bool, turned: bool, smooth: bool) -> str:
    """mirrored: x negated. turned: the corners of each face in the other order."""
    corners = CORNERS * ([-1, 1, 1] if mirrored else [1, 1, 1])
    normals = normalized(corners + np.array([0, 1.0, 0]))
    lines = [f"v {x} {y} {z}" for x, y, z in corners]
    lines += [f"vn {x} {y} {z}" for x, y, z in normals] if smooth else []
    for face in TENT_FACES:
        order = reversed(face) if turned else face
        lines.append("f " + " ".join(f"{i + 1}//{i + 1}" if smooth else f"{i + 1}" for i in order))
    return "\n".join(lines) + "\n"


MIRROR_X = [-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]


@pytest.mark.parametrize("smooth", [False, True], ids=["flat", "smooth"])
def test_a_mirror_keeps_the_outside_outside(tmp_path: Path, smooth: bool) -> None:
    lights = [
        point_light([2, 5, 3], [300, 200, 100]),
        point_light([-4, 3, -1], [50, 90, 200]),
    ]

    def picture(text: str, **placement: object) -> Pixels:
        write_mesh(tmp_path, "tent.obj", text)
        objects = [mesh("tent.obj", "paint", **placement)]
        return render(write_scene(tmp_path, scene_of(objects, lights, LOOKING_DOWN)), tmp_path)

    by_transform = picture(tent(False, False, smooth), transform=MIRROR_X)
    by_hand = picture(tent(True, True, smooth))
    assert (by_hand.sum(axis=-1) > 0).mean() > 0.05
    np.testing.assert_allclose(by_transform, by_hand, rtol=1e-3, atol=1e-4)
    inside_out = picture(tent(True, False, smooth))
    assert inside_out.sum() < 0.1 * by_hand.sum(), "a surface is black from behind"


# Scales -------------------------------------------------------------------------------------------


# A ring of 24 x 12 quads: curved, with many shared edges, in its own shadow.
def torus(scale: float) -> str:
    rows, columns = 24, 12
    lines = []
    for i in range(rows):
        for k in range(columns):
            a, b = 2 * np.pi * i / rows, 2 * np.pi * k / columns
            r = 1.0 + 0.4 * np.cos(b)
            x, y, z = r * np.cos(a), 0.45 + 0.4 * np.sin(b), r * np.sin(a)
            # Rounded first, so that a scale that is a power of two is exact.
            lines.append("v " + " ".join(repr(float(np.float32(v)) * scale) for v in (x, y, z)))
    for i in range(rows):
        for k in range(columns):
            i1, k1 = (i + 1) % rows, (k + 1) % columns
            quad = (i * columns + k, i * columns + k1, i1 * columns + k1, i1 * columns + k)
            lines.append("f " + " ".join(str(n + 1) for n in quad))
    return "\n".join(lines) + "\n"


def scaled_picture(folder: Path, s: float) -> Pixels:
    write_mesh(folder, "torus.obj", torus(s))
    corners = [(-9, 9), (9, 9), (9, -9), (-9, -9)]
    floor = "".join(f"v {x * s!r} 0 {z * s!r}\n" for x, z in corners) + "f 1 2 3 4\n"
    write_mesh(folder, "floor.obj", floor)
    objects = [
        mesh("floor.obj", "paint"),
        mesh("torus.obj", "other"),
        sphere([0.0, 1.5 * s, 0.0], 0.5 * s, "paint"),
    ]
    lights = [
        point_light([2 * s, 5 * s, 3 * s], [300 * s * s] * 3),
        point_light([-4 * s, 0.5 * s, s], [90 * s * s] * 3),
    ]
    camera = {**LOOKING_DOWN, "position": [0.5 * s, 3 * s, 5 * s], "look_at": [0, 0.5 * s, 0]}
    return render(write_scene(folder, scene_of(objects, lights, camera)), folder)


@pytest.mark.parametrize("scale", [1e-3, 1e4])
def test_no_scale_is_special(tmp_path: Path, scale: float) -> None:
    """The same picture from sand to mountains: no acne, no leak. Where a sample lies on an edge
    or on a shadow's rim, rounding decides; that is a pixel here and there."""
    one, other = scaled_picture(tmp_path, 1.0), scaled_picture(tmp_path, scale)
    assert (one.sum(axis=-1) > 0).mean() > 0.5
    differs = ~np.isclose(other, one, rtol=1e-3, atol=1e-4).all(axis=-1)
    assert differs.sum() <= 0.002 * differs.size


@pytest.mark.parametrize("exponent", [-10, 13])
def test_a_power_of_two_changes_no_bit(tmp_path: Path, exponent: int) -> None:
    """Scaling by 2^n is exact in floating point. A length in the code would not scale."""
    one, other = scaled_picture(tmp_path, 1.0), scaled_picture(tmp_path, 2.0**exponent)
    assert np.array_equal(one, other)
