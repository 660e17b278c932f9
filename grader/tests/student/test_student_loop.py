"""`make check`, `hint` and `debug` in the student edition, with right and wrong modules."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest
from student_edition import RIGHT, ROOT, TRIANGLE, run_make, stub, student_edition, write_module


@pytest.fixture
def folder() -> Iterator[Path]:
    """The edition, as it was handed out before and after each test."""
    edition = student_edition()
    write_module(edition, stub())
    yield edition
    write_module(edition, stub())


def right() -> str:
    return RIGHT.read_text(encoding="utf-8")


def wrong(folder: Path) -> None:
    """A module whose hits near one corner are lost."""
    text = right()
    place = text.index("    return true;", text.index("hit->b2 ="))
    write_module(
        folder, text[:place] + "    if (hit->b1 > 0.8f)\n        return false;\n" + text[place:]
    )


def test_a_right_module(folder: Path) -> None:
    write_module(folder, right())
    checked = run_make(folder, "check")
    assert checked.returncode == 0, checked.stdout + checked.stderr
    [line] = [line for line in checked.stdout.splitlines() if "01 triangle" in line]
    assert line.startswith("\N{CHECK MARK}") and "the picture is right" in line


def test_a_wrong_module_is_told_in_words_and_shown(folder: Path) -> None:
    wrong(folder)
    checked = run_make(folder, "check", "A=01")
    assert checked.returncode != 0
    assert "corners_belong_to_the_triangle: corner p1 is part of the triangle" in checked.stdout
    assert "assignments/01-triangle/test_triangle.c:" in checked.stdout
    assert "picture of cornell-box: " in checked.stdout
    sheet = folder / "build/check/01-triangle-cornell-box.png"
    assert sheet.read_bytes().startswith(b"\x89PNG")
    assert "make debug A=01 SCENE=scenes/cornell-box.json PIXEL=" in checked.stdout
    whole = run_make(folder, "check").stdout
    assert "make check A=01 tells all" in whole
    assert whole.count("\N{BALLOT X}") == 1


def test_words_and_spaces_are_no_beginning(folder: Path) -> None:
    stub = (folder / TRIANGLE).read_text(encoding="utf-8")
    write_module(folder, "/* I shall begin tomorrow. */\n" + stub.replace("\n", "\n\n"))
    assert "not begun: src/shapes/triangle.c" in run_make(folder, "check").stdout


def test_a_module_that_does_not_compile(folder: Path) -> None:
    write_module(folder, right() + "int broken = no_such_name;\n")
    checked = run_make(folder, "check", "A=01,2")
    assert checked.returncode != 0
    line = len(right().splitlines()) + 1
    assert f"does not compile: {TRIANGLE}:{line}:" in checked.stdout
    assert "no_such_name" in checked.stdout
    assert "not begun: src/accel/aabb.c" in checked.stdout


def test_a_warning_costs_no_test(folder: Path) -> None:
    text = right()
    place = text.index("{\n", text.index("triangle_intersect")) + 2
    write_module(folder, text[:place] + "    int unused_thing;\n" + text[place:])
    checked = run_make(folder, "check", "A=01")
    assert checked.returncode == 0
    assert "unused_thing" in checked.stdout and "1 compiler warning" in checked.stdout


def test_a_crash(folder: Path) -> None:
    text = right()
    place = text.index("    return true;", text.index("hit->b2 ="))
    crash = "    if (hit->b1 > 0.8f)\n        *(volatile int *)0 = 1;\n"
    write_module(folder, text[:place] + crash + text[place:])
    checked = run_make(folder, "check", "A=01")
    assert checked.returncode != 0
    assert "crashed in the test after edges_belong_to_the_triangle (SIGSEGV)" in checked.stdout


def test_unknown_assignments_are_named(folder: Path) -> None:
    checked = run_make(folder, "check", "A=77")
    assert checked.returncode != 0
    assert "A=77: no such assignment, expected one of 00, 01," in checked.stderr


def test_hints_come_one_at_a_time(folder: Path) -> None:
    memory = folder / "build/hints.json"
    memory.unlink(missing_ok=True)
    early = run_make(folder, "hint", "A=01", "HINT=2")
    assert early.returncode != 0 and "take hint 1 first" in early.stderr
    texts = [run_make(folder, "hint", "A=01").stdout for _ in range(3)]
    assert [text.splitlines()[0] for text in texts] == [
        f"hint {n} for assignment 01" for n in (1, 2, 3)
    ]
    assert run_make(folder, "hint", "A=01", "HINT=1").stdout == texts[0]
    last = run_make(folder, "hint", "A=01")
    assert last.returncode != 0 and "all 3 hints of assignment 01 are taken" in last.stderr
    assert "01 triangle: 3 of 3 hints taken" in run_make(folder, "hint").stdout


def test_debug_names_the_first_wrong_step(folder: Path) -> None:
    text = right()
    place = text.index("    return true;", text.index("hit->b2 ="))
    write_module(folder, text[:place] + "    hit->t *= 1.25f;\n" + text[place:])
    told = run_make(folder, "debug", "A=01", "PIXEL=30,20").stdout
    assert "(the nearest to 30,20 whose right paths are known here)" in told
    assert "The first step that differs (sample 0): which object the ray meets, and where." in told
    yours, expected = (
        next(line for line in told.splitlines() if line.startswith(f"  {who}:"))
        for who in ("yours", "expected")
    )
    assert yours != expected
    t_yours, t_expected = (float(x.split("t = ")[1].split(",")[0]) for x in (yours, expected))
    assert abs(t_yours / t_expected - 1.25) < 1e-3


def test_debug_of_a_right_module(folder: Path) -> None:
    write_module(folder, right())
    told = run_make(folder, "debug", "SCENE=scenes/cornell-box.json", "PIXEL=28,20").stdout
    assert "All steps are as expected." in told
    outside = run_make(folder, "debug", "A=01", "PIXEL=64,0")
    assert "the picture has 64 x 64 pixels" in outside.stderr


def test_here_the_reference_is_all_done() -> None:
    """In the course's own checkout the same command checks the reference itself."""
    command = ["make", "-C", str(ROOT), "check", "A=01,02"]
    checked = subprocess.run(command, capture_output=True, text=True)
    assert checked.returncode == 0, checked.stdout + checked.stderr
    assert checked.stdout.count("\N{CHECK MARK}") == 2


def test_watch_shows_the_picture_each_time(folder: Path) -> None:
    write_module(folder, right())
    command = [str(ROOT / "build/venv/bin/python"), "-m", "raybook_grader.student", "watch"]
    environment = {
        "PATH": os.environ["PATH"],
        "PYTHONPATH": "tools",
        "UNITY_ROOT": os.environ.get("UNITY_ROOT") or str(ROOT / "build/unity"),
    }
    once = subprocess.run(
        [*command, "--assignment", "01", "--rounds", "1"],
        cwd=folder,
        env=environment,
        capture_output=True,
        text=True,
    )
    assert once.returncode == 0, once.stderr
    assert " tests pass, the picture is right" in once.stdout
    assert "build/check/01-triangle-cornell-box.png: yours, expected, difference" in once.stdout
    assert "waiting for the next save" in once.stdout
