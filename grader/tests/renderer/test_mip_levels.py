"""The level of a mipmap that a lookup chooses, read off pictures, against the exact footprint.

Once from the channel and the view that tell the level; and once from what the lookup itself did:
coloured_levels.c paints each level with a colour of its own, and what is mixed shows.
"""

from __future__ import annotations

import subprocess
from pathlib import Path

import numpy as np
import OpenEXR
import pytest
from mip_planes import Array, Plane
from renderer_runs import ROOT, Pixels, make, read_exr, render, run, write_scene

from raybook_grader.judge.exr import write_exr

CLAIM = 0.1
"""How near the level must be. What was measured is below 0.003: samples lie up to a thousandth of
a pixel beside the centre, which counts at the horizon."""
CENTRE = 0.001

PLANES = {
    "facing": Plane(0, 0, 45, (48, 48), (64, 64), (150, 150)),
    "facing, magnified": Plane(0, 30, 45, (48, 48), (64, 64), (6, 6)),
    "30 degrees": Plane(30, 20, 60, (60, 40), (128, 128), (100, 100)),
    "60 degrees, wide image": Plane(60, 0, 40, (40, 60), (256, 64), (40, 90)),
    "75 degrees, turned": Plane(75, 50, 35, (60, 40), (64, 256), (120, 60)),
    "85 degrees, tele": Plane(85, -35, 8, (48, 36), (128, 128), (60, 60), target=(0.2, 0.1, 0)),
    "85 degrees, horizon": Plane(85, 10, 70, (64, 48), (200, 100), (60, 100), (0.5, 0.2, 3.0)),
    "wide angle": Plane(50, 70, 110, (64, 32), (100, 300), (80, 40), (0.0, 0.5, 2.0)),
}


def levels_as_colours(count: int) -> Array:
    """Red tells the level, green whether it is odd; blue is the same, to divide by."""
    level = np.arange(count)
    return np.stack([level / 16, 0.1 + 0.8 * (level % 2), np.full(count, 0.5)], axis=-1)


def level_of_colours(picture: Pixels) -> Array:
    """The level that the mixed colours tell; green must tell the same."""
    level = picture[..., 0] / picture[..., 2].astype(float) * 8
    from_even = np.abs((level + 1) % 2 - 1)
    assert np.allclose(picture[..., 1] / picture[..., 2] / 2, 0.1 + 0.8 * from_even, atol=1e-3)
    return np.asarray(level)


def scene_file(plane: Plane, folder: Path, texture_filter: str) -> Path:
    width, height = plane.texels
    write_exr(folder / "texture.exr", np.full((height, width, 3), 0.5, np.float32))
    return write_scene(folder, plane.scene("texture.exr", texture_filter, 1, CENTRE))


def expect_levels(name: str, found: Array, exact: Array) -> None:
    error = np.abs(found - exact)
    between = np.mean(exact % 1 > 0)
    print(
        f"{name}: {error.size} pixels, levels {exact.min():.2f} to {exact.max():.2f} "
        f"({between:.0%} between the ends), largest error {error.max():.6f}"
    )
    assert error.size > 500
    assert error.max() < CLAIM, f"{name}: off by up to {error.max()}"


@pytest.fixture(scope="module")
def painter(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """coloured_levels.c, linked with the renderer."""
    out = tmp_path_factory.mktemp("painter") / "coloured_levels"
    compiler, objects, libraries = (
        make("-s", f"list-{what}").splitlines()[-1].split()
        for what in ("compiler", "objects", "libraries")
    )
    source = ROOT / "grader" / "tests" / "renderer" / "coloured_levels.c"
    command = [*compiler, str(source), *objects, *libraries, "-o", str(out)]
    subprocess.run(command, cwd=ROOT, check=True)
    return out


def painted(painter: Path, scene: Path, plane: Plane, folder: Path) -> Pixels:
    """The picture with one colour a level."""
    np.savetxt(folder / "colours.txt", levels_as_colours(plane.level_count()))
    output = folder / "coloured.exr"
    subprocess.run([painter, scene, output, folder / "colours.txt"], check=True)
    return read_exr(output).pixels


@pytest.mark.parametrize("name", PLANES)
def test_the_level_told_is_that_of_the_footprint(name: str, tmp_path: Path) -> None:
    plane = PLANES[name]
    seen = plane.footprint()[1]
    scene, output = scene_file(plane, tmp_path, "trilinear"), tmp_path / "picture.exr"
    assert run(scene, "-o", output, "--aov", "mip_level", cwd=tmp_path).returncode == 0
    with OpenEXR.File(str(output), separate_channels=True) as file:
        level = file.channels()["mip_level"].pixels.astype(float)
    expect_levels(name, level[seen], plane.trilinear_level()[seen])
    assert np.all(level[~seen] == 0)


def level_of_heat(picture: Pixels) -> Array:
    """The view's scale: blue, cyan, green, yellow, red for the levels 0, 2, 4, 6, 8."""
    red, green, blue = (picture[..., i].astype(float) for i in range(3))
    return np.asarray(2 * np.where(blue < 1, 3 + red - green - blue, green))


@pytest.mark.parametrize("name", PLANES)
def test_the_view_shows_the_level_of_the_footprint(name: str, tmp_path: Path) -> None:
    plane = PLANES[name]
    seen = plane.footprint()[1]
    scene = scene_file(plane, tmp_path, "trilinear")
    view = render(scene, tmp_path, "--integrator", "mip_level")
    exact = np.minimum(plane.trilinear_level(), 8)
    expect_levels(f"{name}, view", level_of_heat(view[seen]), exact[seen])


@pytest.mark.parametrize("texture_filter", ["trilinear", "ewa"])
@pytest.mark.parametrize("name", PLANES)
def test_a_lookup_mixes_the_levels_of_the_footprint(
    painter: Path, name: str, texture_filter: str, tmp_path: Path
) -> None:
    plane = PLANES[name]
    seen = plane.footprint()[1]
    scene = scene_file(plane, tmp_path, texture_filter)
    found = level_of_colours(painted(painter, scene, plane, tmp_path)[seen])
    exact = plane.trilinear_level() if texture_filter == "trilinear" else plane.ewa_level(8)
    expect_levels(f"{name}, {texture_filter}", found, exact[seen])


WRONG_LEVELS = {
    "shorter side": lambda steps: np.linalg.norm(steps, axis=-2).min(axis=-1),
    "longer axis of the ellipse": lambda steps: np.linalg.norm(steps, 2, axis=(-2, -1)),
    "root of the area": lambda steps: np.sqrt(np.abs(np.linalg.det(steps))),
    "one component": lambda steps: np.abs(steps).max(axis=(-2, -1)),
    "sum of components": lambda steps: np.abs(steps).sum(axis=-2).max(axis=-1),
    "half a pixel": lambda steps: 0.5 * np.linalg.norm(steps, axis=-2).max(axis=-1),
}


@pytest.mark.parametrize("wrong", WRONG_LEVELS)
def test_the_planes_tell_footprints_apart(wrong: str) -> None:
    """Another footprint gives levels that are further off than allowed, in many pixels."""
    off = []
    for plane in PLANES.values():
        steps, seen = plane.footprint()
        level = np.clip(np.log2(WRONG_LEVELS[wrong](steps)), 0, plane.level_count() - 1)
        off.append(np.mean((np.abs(level - plane.trilinear_level()) > CLAIM)[seen]))
    print(f"{wrong}: off in {', '.join(f'{share:.0%}' for share in off)} of the planes' pixels")
    assert max(off) > 0.3
