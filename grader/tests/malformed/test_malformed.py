"""Bad input gives one clear message, exit code 2, and no file."""

from __future__ import annotations

import os
import re
import subprocess
from pathlib import Path

import pytest
from corpus import BASE, CASES, GOOD_SCENE, LATER, TRIANGLE, Case, Content, Fifo, Folder, Link

HANG_SECONDS = 10.0
"""A run that takes this long hangs; the slowest case takes a few hundredths of it."""
MOST_LINES = 4
"""The message, and the line of the input with a caret below it."""


CHECKOUT = Path(__file__).resolve().parents[3]


@pytest.fixture(scope="session")
def raybook() -> Path:
    """The renderer: RAYBOOK_BINARY, or the one that `make` builds."""
    path = Path(os.environ.get("RAYBOOK_BINARY", CHECKOUT / "build" / "raybook")).resolve()
    assert path.is_file(), f"{path} is not there: run `make` first"
    return path


def put(path: Path, content: Content) -> None:
    """Make a file, or what stands in its place."""
    match content:
        case Folder():
            path.mkdir()
        case Fifo():
            os.mkfifo(path)
        case Link(target):
            path.symlink_to(target)
        case bytes():
            path.write_bytes(content)


def run(
    raybook: Path, folder: Path, arguments: tuple[str, ...]
) -> subprocess.CompletedProcess[str]:
    """The renderer's answer, in a folder of its own."""
    return subprocess.run(
        [raybook, *arguments],
        cwd=folder,
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        errors="replace",
        timeout=HANG_SECONDS,
        check=False,
    )


def slug(case: Case) -> str:
    """The case's name, as pytest shows it."""
    return case.name.replace(" ", "-")


def run_case(raybook: Path, folder: Path, case: Case) -> subprocess.CompletedProcess[str]:
    """The renderer's answer to a case."""
    for name, content in case.files.items():
        put(folder / name, content)
    return run(raybook, folder, case.arguments)


def check_refusal(case: Case, folder: Path, result: subprocess.CompletedProcess[str]) -> None:
    """One message that says what, where and what was expected; exit code 2; no new file."""
    lines = result.stderr.splitlines()
    assert result.returncode == 2, result.stderr
    assert result.stdout == ""
    assert 1 <= len(lines) <= MOST_LINES, result.stderr
    assert [line.startswith("raybook: ") for line in lines] == [True] + [False] * (len(lines) - 1)
    assert all(line.startswith(" ") for line in lines[1:]), "one message, then the input's line"
    for pattern in case.says:
        assert re.search(pattern, result.stderr), f"{pattern!r} is not in: {result.stderr}"
    assert {p.name for p in folder.iterdir()} == set(case.files), "a file was left"


@pytest.mark.parametrize("case", CASES, ids=slug)
def test_is_refused(raybook: Path, tmp_path: Path, case: Case) -> None:
    check_refusal(case, tmp_path, run_case(raybook, tmp_path, case))


@pytest.mark.parametrize("case", LATER, ids=slug)
def test_works_or_is_refused_by_name(raybook: Path, tmp_path: Path, case: Case) -> None:
    result = run_case(raybook, tmp_path, case)
    if result.returncode != 0:
        check_refusal(case, tmp_path, result)


def test_case_names_differ() -> None:
    names = [case.name for case in (*CASES, *LATER)]
    assert len(names) == len(set(names))


def test_base_scene_is_fine(raybook: Path, tmp_path: Path) -> None:
    """Else every case above could be refused for a fault of the base."""
    put(tmp_path / "scene.json", GOOD_SCENE)
    put(tmp_path / "mesh.obj", TRIANGLE)
    result = run(raybook, tmp_path, ("-q", "scene.json", "-o", "out.exr"))
    assert (result.returncode, result.stderr) == (0, "")
    assert (tmp_path / "out.exr").stat().st_size > 0


def test_byte_order_mark_is_passed_over(raybook: Path, tmp_path: Path) -> None:
    """Some editors write one before UTF-8; it changes nothing."""
    put(tmp_path / "scene.json", b"\xef\xbb\xbf" + GOOD_SCENE)
    put(tmp_path / "mesh.obj", TRIANGLE)
    result = run(raybook, tmp_path, ("-q", "scene.json", "-o", "out.exr"))
    assert (result.returncode, result.stderr) == (0, "")


def test_an_older_image_is_kept(raybook: Path, tmp_path: Path) -> None:
    """A refused scene does not harm the picture of the day before."""
    put(tmp_path / "scene.json", b"{")
    put(tmp_path / "out.exr", b"yesterday")
    assert run(raybook, tmp_path, ("scene.json", "-o", "out.exr")).returncode == 2
    assert (tmp_path / "out.exr").read_bytes() == b"yesterday"


def test_paths_are_relative_to_the_scene(raybook: Path, tmp_path: Path) -> None:
    """The message about a mesh names the path that was tried."""
    assert BASE["objects"][1]["path"] == "mesh.obj"
    (tmp_path / "there").mkdir()
    put(tmp_path / "there" / "scene.json", GOOD_SCENE)
    result = run(raybook, tmp_path, ("there/scene.json", "-o", "out.exr"))
    assert result.returncode == 2
    assert "there/mesh.obj" in result.stderr
