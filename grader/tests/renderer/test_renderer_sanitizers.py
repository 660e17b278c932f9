"""No undefined behaviour, no bad access, no leak: sanitizers and valgrind watch whole runs."""

from __future__ import annotations

from pathlib import Path

import pytest
from renderer_runs import CORNELL, KNOT, Json, diffuse, program, run, sphere, write_scene

SANITIZERS = {"ASAN_OPTIONS": "detect_leaks=1"}

# What OpenMP's library keeps for itself until the end.
SUPPRESSION = """{
    libgomp
    Memcheck:Leak
    match-leak-kinds: reachable
    fun:malloc
    obj:*libgomp*
    ...
}
"""


@pytest.fixture(scope="module")
def checked() -> Path:
    return program("asan")


def expect_clean(folder: Path, binary: Path, *arguments: str | Path, code: int = 0) -> None:
    done = run(*arguments, cwd=folder, binary=binary, environment=SANITIZERS)
    assert "runtime error" not in done.stderr and "Sanitizer" not in done.stderr, done.stderr
    assert done.returncode == code, done.stderr


def test_the_cornell_box_renders_cleanly(tmp_path: Path, checked: Path) -> None:
    arguments = ("--resolution", "32x32", "--spp", "3", "--stats", "s.json", "--png", "a.png")
    expect_clean(tmp_path, checked, CORNELL, *arguments, "--threads", "2")
    expect_clean(tmp_path, checked, CORNELL, *arguments, "--accel", "linear")


def test_a_mesh_of_100000_triangles_loads_and_renders_cleanly(
    tmp_path: Path, checked: Path
) -> None:
    expect_clean(tmp_path, checked, KNOT, "--resolution", "32x32", "--spp", "1")


def test_refused_scenes_leak_nothing(tmp_path: Path, checked: Path) -> None:
    """The fault is found at different depths of loading; all that was loaded is released."""
    ball = sphere([0, 0, 0], 1, "paint")
    good = {"objects": [ball], **diffuse(paint=[0.5, 0.5, 0.5])}
    mistakes: tuple[Json, ...] = (
        {"camra": {}},
        {"film": {"resolution": [0, 0]}},
        {"objects": [ball, {**ball, "radius": -1}]},
        {"objects": [ball, {**ball, "material_name": "pant"}]},
        {"objects": [ball, {"type": "mesh", "path": "none.obj", "material_name": "paint"}]},
    )
    for bad in mistakes:
        scene = write_scene(tmp_path, {**good, **bad})
        expect_clean(tmp_path, checked, scene, code=2)
    expect_clean(tmp_path, checked, "no-such.json", code=2)
    expect_clean(tmp_path, checked, scene, "--override", '{"a": {"b"', code=2)
    expect_clean(tmp_path, checked, "--spq", code=2)
    expect_clean(tmp_path, checked, "--help")


@pytest.mark.parametrize(
    ("threads", "kinds"),
    # OpenMP's second thread is still there at the end, with all that it holds.
    [("1", "all"), ("2", "definite")],
)
def test_valgrind_finds_no_leak(tmp_path: Path, threads: str, kinds: str) -> None:
    (tmp_path / "libgomp.supp").write_text(SUPPRESSION)
    valgrind = [
        "valgrind",
        "--quiet",
        "--leak-check=full",
        f"--show-leak-kinds={kinds}",
        f"--errors-for-leak-kinds={kinds}",
        f"--suppressions={tmp_path / 'libgomp.supp'}",
        "--error-exitcode=9",
    ]
    arguments = ("--resolution", "8x8", "--spp", "1", "-q", "--threads", threads)
    done = run(CORNELL, *arguments, cwd=tmp_path, binary=program("debug"), wrapper=valgrind)
    assert (done.returncode, done.stderr) == (0, "")
    assert (tmp_path / "cornell-box.exr").is_file()
