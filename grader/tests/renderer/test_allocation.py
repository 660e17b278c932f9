"""Memory that runs out, wherever it may, gives one clear message and leaves nothing behind.

In a test build (base/memory.h) one allocation after another is made to fail in a run that loads
and renders a scene with every kind of object, light, material, texture and image file, and writes
every kind of output. These allocations are our own, cJSON's, OpenEXRCore's and stb's; those of the
C library, OpenMP and zlib are not among them.
"""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import pytest
from renderer_runs import ROOT, make, read_exr, run

sys.path.insert(0, str(ROOT / "grader" / "tests" / "fuzz"))

from fuzz_seeds import furniture

MOST = 20_000
"""More allocations than any run makes."""
OUTPUTS = ("-o", "out.exr", "--png", "out.png", "--stats", "out.json", "--aov", "albedo,variance")

IMAGES = {kind: {"type": "image", "path": f"image.{kind}"} for kind in ("png", "exr", "hdr", "jpg")}
GREY = {"type": "constant", "color": [0.5, 0.5, 0.5]}
RECT = [4, 0, 0, 0, 0, 0, 4, 0, 0, -4, 0, 0, 0, 0, 0, 1]
GLOW = {"type": "area", "radiance": [1, 1, 1]}
SCENE: dict[str, Any] = {
    "integrator": {"type": "path", "spp": 1, "max_depth": 2, "light_selection": "power"},
    "film": {"resolution": [2, 2], "filter": {"type": "gaussian"}},
    "sampler": {"type": "sobol"},
    "camera": {"position": [0, 1, 5], "look_at": [0, 0, 0]},
    "textures": {"grey": GREY, "check": {"type": "checkerboard"}, **IMAGES},
    "materials": {
        "check": {"type": "diffuse", "texture_name": "check"},
        "png": {"type": "diffuse", "texture_name": "png"},
        "refraction": {"type": "refraction"},
        "glass": {"type": "glass", "R": [1, 1, 1]},
        "metal": {"type": "roughconductor"},
    },
    "lights": [
        {"type": "point", "position": [0, 3, 0], "flux": [9, 9, 9]},
        {"type": "directional", "direction": [0, -1, 0], "irradiance": [1, 1, 1]},
        {"type": "spot", "position": [0, 3, 0], "direction": [0, -1, 0], "intensity": [1, 1, 1]},
    ],
    "environment_map": {"texture_name": "exr"},
    "objects": [
        {"type": "rect", "transform": RECT, "material_name": "check", "light": GLOW},
        {"type": "sphere", "center": [1, 1, 0], "radius": 0.5, "material_name": "glass"},
        {"type": "sphere", "center": [-1, 1, 0], "radius": 0.3, "light": GLOW},
        {"type": "mesh", "path": "mesh.obj", "material_name": "png", "light": GLOW},
    ],
}


@pytest.fixture(scope="module")
def program(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The renderer with base/memory.c compiled for the test."""
    objects = make("-s", "list-objects").splitlines()[-1].split()
    memory = next(path for path in objects if path.endswith("base/memory.o"))
    rest = [path.replace("base/memory.o", "main.o") for path in objects if path == memory]
    rest += [path for path in objects if path != memory]
    out = tmp_path_factory.mktemp("allocation") / "raybook"
    command = [
        *make("-s", "list-compiler").splitlines()[-1].split(),
        *("-DRAYBOOK_TEST_ALLOCATION", "src/base/memory.c", *rest),
        *make("-s", "list-libraries").splitlines()[-1].split(),
        *("-o", str(out)),
    ]
    subprocess.run(command, cwd=ROOT, check=True)
    return out


def fill(folder: Path, scene: dict[str, Any]) -> None:
    """The scene and the files that it names."""
    folder.mkdir()
    for name, data in furniture().items():
        (folder / name).write_bytes(data)
    (folder / "scene.json").write_text(json.dumps(scene, separators=(",", ":")))


def one_run(program: Path, folder: Path, number: int) -> subprocess.CompletedProcess[str]:
    """A run in which that allocation fails (0: none)."""
    environment = {"RAYBOOK_FAIL_ALLOCATION": str(number)}
    arguments = ("scene.json", "--threads", "1", "-q", *OUTPUTS)
    return run(*arguments, cwd=folder, binary=program, environment=environment)


def outputs(folder: Path) -> Iterator[Path]:
    return folder.glob("out.*")


def failed_cleanly(program: Path, folder: Path, number: int) -> bool:
    """Checks one run; False when it made fewer allocations than that.

    An output is there whole or not at all: the image is not taken back because memory ran out
    while its preview was written.
    """
    for path in outputs(folder):
        path.unlink()
    done = one_run(program, folder, number)
    if done.returncode == 0:
        return False
    lines = done.stderr.splitlines()
    assert done.returncode == 1, f"allocation {number}: {done}"
    assert len(lines) == 1, f"allocation {number}: {done.stderr}"
    assert lines[0].startswith("raybook: out of memory"), f"allocation {number}: {done.stderr}"
    assert {path.name for path in outputs(folder)} <= {"out.exr", "out.png", "out.json"}
    if (folder / "out.exr").exists():
        assert read_exr(folder / "out.exr").pixels.shape == (2, 2, 3)
    return True


def count_of_clean_failures(program: Path, folder: Path, scene: dict[str, Any]) -> int:
    """Makes every allocation fail, two runs at a time; how many there were."""

    def every_second(first: int) -> int:
        mine = folder / str(first)
        fill(mine, scene)
        assert one_run(program, mine, 0).returncode == 0
        count = 0
        while first + 2 * count < MOST and failed_cleanly(program, mine, first + 2 * count):
            count += 1
        return count

    with ThreadPoolExecutor(2) as pool:
        return sum(pool.map(every_second, (1, 2)))


def test_every_allocation_may_fail(program: Path, tmp_path: Path) -> None:
    count = count_of_clean_failures(program, tmp_path, SCENE)
    print(f"{count} allocations")
    assert 500 < count < MOST - 2


def test_told_to_fail_nothing_it_renders(program: Path, tmp_path: Path) -> None:
    folder = tmp_path / "run"
    fill(folder, SCENE)
    assert one_run(program, folder, 0).returncode == 0
    assert {path.name for path in outputs(folder)} == {"out.exr", "out.png", "out.json"}
