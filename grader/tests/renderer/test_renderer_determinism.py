"""A pixel depends on scene, seed, pixel and sample index only: the same bits in any other way."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import numpy.typing as npt
import pytest
from renderer_runs import (
    CORNELL,
    KNOT,
    ROOT,
    Json,
    Pixels,
    diffuse,
    mesh,
    program,
    render,
    sphere,
    write_mesh,
    write_scene,
)

SMALL = ("--resolution", "52x44", "--spp", "5")


@pytest.fixture(scope="module")
def reference(tmp_path_factory: pytest.TempPathFactory) -> Pixels:
    """The Cornell box by one thread."""
    return render(CORNELL, tmp_path_factory.mktemp("one"), *SMALL, "--threads", "1")


@pytest.mark.parametrize("threads", ["2", "3", "16"])
def test_threads_change_no_bit(tmp_path: Path, reference: Pixels, threads: str) -> None:
    assert reference.any()
    assert np.array_equal(reference, render(CORNELL, tmp_path, *SMALL, "--threads", threads))


@pytest.mark.parametrize("window", [(0, 0, 52, 44), (7, 5, 30, 29), (51, 43, 52, 44)])
def test_a_window_shows_what_the_whole_shows(
    tmp_path: Path, reference: Pixels, window: tuple[int, int, int, int]
) -> None:
    x0, y0, x1, y1 = window
    crop = render(CORNELL, tmp_path, *SMALL, "--crop", f"{x0},{y0},{x1},{y1}")
    assert np.array_equal(reference[y0:y1, x0:x1], crop)


def test_the_time_of_day_changes_no_bit(tmp_path: Path, reference: Pixels) -> None:
    assert np.array_equal(reference, render(CORNELL, tmp_path, *SMALL))


def test_another_seed_is_another_picture_of_the_same(tmp_path: Path, reference: Pixels) -> None:
    other = render(CORNELL, tmp_path, *SMALL, "--seed", "1")
    lit = reference.any(axis=-1)
    assert lit.mean() > 0.5
    assert (other != reference).any(axis=-1)[lit].mean() > 0.95, "the seed has no effect"
    assert np.allclose(other.mean(axis=(0, 1)), reference.mean(axis=(0, 1)), rtol=0.05)


def test_two_compilers_agree(tmp_path: Path, reference: Pixels) -> None:
    """Not to the last bit: their sin and cos may differ. No pixel is another one."""
    clang = render(CORNELL, tmp_path, *SMALL, binary=program("debug", "clang"))
    debug = render(CORNELL, tmp_path, *SMALL, binary=program("debug", "gcc"))
    for other in (clang, debug):
        close = np.isclose(other, reference, rtol=1e-4, atol=1e-6).all(axis=-1)
        assert close.mean() > 0.995


def soup(count: int) -> str:
    """Triangles of all sizes and directions in the cube [-1, 1]^3."""
    random = np.random.default_rng(7)
    lines = []
    sizes, centers = random.uniform(0.01, 0.2, count), random.uniform(-1, 1, (count, 3))
    for size, center in zip(sizes, centers, strict=True):
        for corner in center + size * random.normal(size=(3, 3)):
            lines.append("v " + " ".join(f"{x:.6f}" for x in corner))
    lines += [f"f {3 * i + 1} {3 * i + 2} {3 * i + 3}" for i in range(count)]
    return "\n".join(lines) + "\n"


def soup_scene(folder: Path) -> Path:
    write_mesh(folder, "soup.obj", soup(1500))
    material = diffuse(paint=[0.8, 0.7, 0.6])
    material["materials"]["paint"]["twosided"] = True
    scene: Json = {
        "integrator": {"point_light_position": [3, 4, 5], "point_light_flux": [900, 800, 700]},
        "camera": {"position": [1, 2, 4], "fov": 40},
        "objects": [mesh("soup.obj", "paint"), sphere([0.2, 0.1, 0.3], 0.4, "paint")],
        **material,
    }
    return write_scene(folder, scene)


@pytest.mark.parametrize("accel", ["wide", "bvh"])
def test_the_tree_finds_what_testing_everything_finds(tmp_path: Path, accel: str) -> None:
    scene = soup_scene(tmp_path)
    size = ("--resolution", "48x48", "--spp", "3")
    tree = render(scene, tmp_path, *size, "--accel", accel)
    everything = render(scene, tmp_path, *size, "--accel", "linear")
    assert (tree.sum(axis=-1) > 0).mean() > 0.3
    assert np.array_equal(tree, everything)


@pytest.mark.parametrize("accel", ["wide", "bvh"])
def test_the_tree_over_a_fine_mesh_finds_what_testing_everything_finds(
    tmp_path: Path, accel: str
) -> None:
    size = ("--resolution", "400x400", "--spp", "1", "--crop", "190,180,206,188")
    tree = render(KNOT, tmp_path, *size, "--accel", accel)
    everything = render(KNOT, tmp_path, *size, "--accel", "linear")
    assert tree.any()
    assert np.array_equal(tree, everything)


def counts(picture: Pixels, spp: int) -> npt.NDArray[np.int64]:
    """How many of a pixel's samples met the bright half plane, whose radiance is nearly one
    number everywhere."""
    level = picture.max()
    whole = np.rint(picture[..., 0] / level * spp)
    assert np.abs(picture[..., 0] / level * spp - whole).max() < 0.05
    return np.asarray(whole, np.int64)


def test_more_samples_go_on_where_fewer_ended(tmp_path: Path) -> None:
    """The samples of n + 1 are those of n and one more. The filter is wide and the scene is half
    bright and half black, so a pixel's value tells how many samples met the bright half."""
    write_mesh(tmp_path, "half.obj", "v 0 -9 0\nv 9 -9 0\nv 9 9 0\nv 0 9 0\nf 1 2 3 4\n")
    light = {"point_light_position": [0, 0, 1000], "point_light_flux": [1e7] * 3}
    scene: Json = {
        "integrator": light,
        "film": {"resolution": [24, 16], "filter": {"type": "box", "radius": 12}},
        "camera": {"position": [0, 0, 4], "fov": 30},
        "objects": [mesh("half.obj", "paint")],
        **diffuse(paint=[0.5, 0.5, 0.5]),
    }
    path = write_scene(tmp_path, scene)
    before: npt.NDArray[np.int64] = np.zeros((16, 24), np.int64)
    for spp in range(1, 13):
        now = counts(render(path, tmp_path, "--spp", str(spp)), spp)
        assert np.isin(now - before, (0, 1)).all()
        before = now
    assert 0.2 < before.mean() / 12 < 0.8 and len(np.unique(before)) > 8


@pytest.mark.parametrize("name", ["cornell-box", "glass-box", "veach-mis"])
def test_gcc_and_clang_agree(tmp_path: Path, name: str) -> None:
    """Within 1e-4 relative: no contraction, no unsafe reordering; usually the same bits."""
    scene = ROOT / "scenes" / f"{name}.json"
    arguments = ("--resolution", "32x32", "--spp", "8")
    by_gcc = render(scene, tmp_path, *arguments)
    by_clang = render(scene, tmp_path, *arguments, binary=program(cc="clang"))
    assert by_gcc.mean() > 0
    np.testing.assert_allclose(by_clang, by_gcc, rtol=1e-4, atol=1e-6)
