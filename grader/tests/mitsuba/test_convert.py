"""What the converter takes for granted about Mitsuba's conventions. Skipped without Mitsuba."""

import json
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

pytest.importorskip("mitsuba")
sys.path.insert(0, str(Path(__file__).parent))

from convert import convert, convert_filter, convert_shape
from convert_lights import convert_environment, convert_light
from convert_textures import NoCounterpart, convert_texture
from mitsuba_types import load_mitsuba

from raybook_grader.judge.exr import write_exr

mi = load_mitsuba()
dr = pytest.importorskip("drjit")
IDENTITY = np.eye(4)


def floats(value: Any) -> NDArray[np.float64]:
    """Whatever Mitsuba returns for one lane, flat."""
    return np.array(value, dtype=np.float64).ravel()


def our_sky(pixels: NDArray[np.float32], d: NDArray[np.float64]) -> NDArray[np.float64]:
    """The scene format's words: pole +z, texel centres at half integers, wrap in u, clamp in v."""
    height, width = pixels.shape[:2]
    x = (np.arctan2(d[1], d[0]) / (2 * np.pi)) % 1 * width - 0.5
    y = np.arccos(d[2]) / np.pi * height - 0.5
    column, row = int(np.floor(x)), int(np.floor(y))

    def texel(i: int, j: int) -> NDArray[np.float64]:
        color: NDArray[np.float64] = pixels[min(max(j, 0), height - 1), i % width].astype(float)
        return color

    s, t = x - column, y - row
    upper = (1 - s) * texel(column, row) + s * texel(column + 1, row)
    lower = (1 - s) * texel(column, row + 1) + s * texel(column + 1, row + 1)
    sky: NDArray[np.float64] = (1 - t) * upper + t * lower
    return sky


def test_environment_shows_the_same_colour_in_every_direction(tmp_path: Path) -> None:
    random = np.random.default_rng(1)
    pixels = random.random((5, 8, 3)).astype(np.float32)
    write_exr(tmp_path / "sky.exr", pixels)
    turn, _ = np.linalg.qr(random.normal(size=(3, 3)))
    matrix = np.eye(4)
    matrix[:3, :3] = turn
    settings = {"transform": matrix.ravel().tolist(), "scale": 2}
    light = mi.load_dict(
        convert_environment(tmp_path, settings, {"type": "image", "path": "sky.exr"})
    )
    for local in random.normal(size=(100, 3)):
        local /= np.linalg.norm(local)
        at = dr.zeros(mi.SurfaceInteraction3f)
        at.wi = mi.Vector3f(*(float(-v) for v in turn @ local))
        assert floats(light.eval(at)) == pytest.approx(2 * our_sky(pixels, local), abs=2e-5)


@pytest.mark.parametrize("degrees", [0.0, 7.0, 11.0, 14.0, 19.9, 20.1, 60.0])
def test_spot_light_falls_off_as_ours(degrees: float) -> None:
    light = mi.load_dict(
        convert_light(
            {
                "type": "spot",
                "position": [1, 2, 3],
                "direction": [1, -2, 0.5],
                "intensity": [4, 5, 6],
                "cutoff_angle": 20,
                "beam_angle": 10,
            }
        )
    )
    axis = np.array([1, -2, 0.5]) / np.sqrt(5.25)
    across = np.cross(axis, [0.3, 0.1, 1])
    across /= np.linalg.norm(across)
    angle = np.radians(degrees)
    place = [1, 2, 3] + 2 * (np.cos(angle) * axis + np.sin(angle) * across)
    at = dr.zeros(mi.Interaction3f)
    at.p = mi.Point3f(*(float(v) for v in place))
    _, irradiance = light.sample_direction(at, mi.Point2f(0.5, 0.5))
    expected = np.array([4, 5, 6]) / 4 * np.clip((20 - degrees) / (20 - 10), 0, 1)
    assert floats(irradiance) == pytest.approx(expected, abs=1e-4)


def lookup(texture: dict[str, Any], folder: Path, u: float, v: float) -> NDArray[np.float64]:
    """Mitsuba's answer for a texture of ours."""
    at = dr.zeros(mi.SurfaceInteraction3f)
    at.uv = mi.Point2f(u, v)
    return floats(mi.load_dict(convert_texture(folder, texture, IDENTITY)).eval(at))


def test_texture_coordinates_are_scaled_then_moved(tmp_path: Path) -> None:
    pixels = np.random.default_rng(2).random((2, 4, 3)).astype(np.float32)
    write_exr(tmp_path / "a.exr", pixels)
    texture = {
        "type": "image",
        "path": "a.exr",
        "filter": "nearest",
        "tex_coordinate_generator": {"scale": [2, 0.5], "delta": [-0.1, 0.4]},
    }
    # u' = 0.4, v' = 0.6: second column, second row
    assert lookup(texture, tmp_path, 0.25, 0.4) == pytest.approx(pixels[1, 1], abs=1e-6)


def test_black_wrap_blends_into_black(tmp_path: Path) -> None:
    pixels = np.ones((2, 4, 3), np.float32)
    write_exr(tmp_path / "a.exr", pixels)
    texture = {"type": "image", "path": "a.exr", "filter": "bilinear", "wrap": "black"}
    assert lookup(texture, tmp_path, 1.0, 0.5) == pytest.approx([0.5] * 3, abs=1e-5)
    assert lookup(texture, tmp_path, 1 - 1 / 16, 0.5) == pytest.approx([0.75] * 3, abs=1e-5)
    assert lookup(texture, tmp_path, -3.0, 0.5) == pytest.approx([0.0] * 3, abs=1e-6)


def test_checkerboard_is_color0_where_i_plus_j_is_even(tmp_path: Path) -> None:
    texture = {"type": "checkerboard", "color0": [1, 1, 1], "color1": [0, 0, 0]}
    for u, v in ((0.1, 0.2), (0.7, 0.2), (0.7, 0.9), (-0.2, 0.3), (1.3, 2.6)):
        even = (np.floor(2 * u) + np.floor(2 * v)) % 2 == 0
        assert lookup(texture, tmp_path, u, v)[0] == float(even)


def first_hit(shape: dict[str, Any], origin: list[float], direction: list[float]) -> Any:
    """Where a ray meets a shape."""
    scene = mi.load_dict({"type": "scene", "shape": shape})
    return scene.ray_intersect(mi.Ray3f(mi.Point3f(origin), mi.Vector3f(direction)))


def test_rectangle_is_the_unit_square() -> None:
    shape = convert_shape(Path(), {"type": "rect", "translate": [0, 0, 2]})
    hit = first_hit(shape, [0.4, -0.3, 5], [0, 0, -1])
    assert floats(hit.t) == pytest.approx([3])
    assert floats(hit.sh_frame.n) == pytest.approx([0, 0, 1])
    assert floats(hit.uv) == pytest.approx([0.9, 0.2])  # the converter turns v round
    assert not bool(np.array(first_hit(shape, [0.6, 0, 5], [0, 0, -1]).is_valid()).all())


@pytest.mark.parametrize("with_normals", [False, True])
@pytest.mark.parametrize("mirror", [1, -1])
def test_mesh_keeps_its_normals_outside(tmp_path: Path, with_normals: bool, mirror: int) -> None:
    vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\n"
    corner = "{0}/{0}/1" if with_normals else "{0}/{0}"
    face = " ".join(corner.format(i) for i in (1, 2, 3))
    (tmp_path / "a.obj").write_text(
        (vertices if with_normals else vertices.replace("vn 0 0 1\n", "")) + f"f {face}\n"
    )
    matrix = np.diag([mirror, 1, 1, 1]).ravel().tolist()
    shape = convert_shape(tmp_path, {"type": "mesh", "path": "a.obj", "transform": matrix})
    hit = first_hit(shape, [0.25 * mirror, 0.125, 5], [0, 0, -1])
    assert floats(hit.sh_frame.n) == pytest.approx([0, 0, 1])
    assert floats(hit.uv) == pytest.approx([0.25, 1 - 0.125])  # v flipped once


@pytest.mark.parametrize("kind", ["gaussian", "mitchell", "tent"])
def test_filters_have_our_shape(kind: str) -> None:
    settings = {"type": kind, "radius": 2, "alpha": 2.0, "B": 0.2, "C": 0.4}
    mitsuba = mi.load_dict(convert_filter(settings))

    def ours(x: float) -> float:
        b, c, r = 0.2, 0.4, abs(x)
        if kind == "gaussian":
            return float(np.exp(-2 * x * x) - np.exp(-8))
        if kind == "tent":
            return 1 - r / 2
        if r < 1:
            return ((12 - 9 * b - 6 * c) * r**3 + (-18 + 12 * b + 6 * c) * r**2 + 6 - 2 * b) / 6
        near = (-b - 6 * c) * r**3 + (6 * b + 30 * c) * r**2
        return (near + (-12 * b - 48 * c) * r + 8 * b + 24 * c) / 6

    # Mitsuba evaluates a polynomial that is near its Gaussian.
    near_enough = 1e-3 if kind == "gaussian" else 2e-5
    scale = ours(0) / floats(mitsuba.eval(0.0))[0]
    for x in (-1.5, -0.5, 0.25, 1.25, 1.9):
        assert scale * floats(mitsuba.eval(x))[0] == pytest.approx(ours(x), abs=near_enough)


@pytest.mark.parametrize(
    "change",
    [
        {"materials": {"clear": {"type": "refraction"}}, "objects": [{"type": "sphere"}]},
        {"integrator": {"type": "normal"}},
        {"film": {"filter": {"type": "box", "radius": 1}}},
        {"film": {"filter": {"type": "gaussian", "radius": 1}}},
    ],
)
def test_what_has_no_counterpart_is_refused(tmp_path: Path, change: dict[str, Any]) -> None:
    scene: dict[str, Any] = {"integrator": {"type": "path"}} | change
    for item in scene.get("objects", []):
        item |= {"center": [0, 0, 0], "radius": 1, "material_name": "clear"}
    (tmp_path / "scene.json").write_text(json.dumps(scene))
    with pytest.raises(NoCounterpart):
        convert(tmp_path / "scene.json")
