"""Assignment 00: files that the student made with the tools, graded without compiling anything."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from make_class import CHECKOUT
from small_course import grades, run
from test_grade_course import course

from raybook_grader.course import ArtefactCheck, load_course
from raybook_grader.errors import BadInput
from raybook_grader.judge.exr import write_exr

RUBRIC = """
number = "00"
module = "build"
title = "Build"
points = 5
owned = ["compile_commands.json", "first-picture.exr"]

[[check]]
name = "commands"
kind = "artefact"
points = 2
file = "compile_commands.json"
expects = "compile-commands"

[[check]]
name = "picture"
kind = "artefact"
points = 3
file = "first-picture.exr"
expects = "picture"
resolution = "64x32"
"""


def test_the_rubric_is_read(tmp_path: Path) -> None:
    [assignment] = load_course(course(tmp_path, RUBRIC)).assignments
    assert assignment.sources == ()
    assert assignment.checks[1] == ArtefactCheck(
        "picture", 3.0, "first-picture.exr", "picture", (64, 32)
    )


@pytest.mark.parametrize(
    ("old", "new", "fault"),
    [
        ('"compile-commands"', '"wonders"', "expects: is 'wonders', expected one of"),
        ('resolution = "64x32"', "", "resolution: is missing"),
        ('file = "first-picture.exr"', 'file = "other.exr"', "expected the checks' files"),
        ('owned = ["compile', 'owned = ["src/shapes/triangle.c", "compile', "the checks' files"),
        (
            'kind = "artefact"\npoints = 2\nfile = "compile_commands.json"\n'
            'expects = "compile-commands"',
            'kind = "build"\npoints = 2',
            "either, not both",
        ),
    ],
)
def test_faults_of_the_rubric(tmp_path: Path, old: str, new: str, fault: str) -> None:
    assert old in RUBRIC
    with pytest.raises(BadInput, match=fault):
        load_course(course(tmp_path, RUBRIC.replace(old, new)))


def commands(flag: str = "-Isrc") -> str:
    sources = load_course(CHECKOUT).sources
    return json.dumps(
        [{"directory": "/x", "file": s, "command": f"cc -std=c99 {flag} -c {s}"} for s in sources]
    )


def hand_in(folder: Path, commands: str | None, picture: bytes | tuple[int, int] | None) -> None:
    folder.mkdir(parents=True)
    if commands is not None:
        (folder / "compile_commands.json").write_text(commands)
    if isinstance(picture, bytes):
        (folder / "first-picture.exr").write_bytes(picture)
    elif picture:
        pixels = np.random.default_rng(0).random((*picture, 3), dtype=np.float32)
        write_exr(folder / "first-picture.exr", pixels)


def test_a_class(tmp_path: Path) -> None:
    hand_in(tmp_path / "class/right", commands(), (128, 128))
    hand_in(tmp_path / "class/half", commands("-Isources"), (128, 128))
    hand_in(tmp_path / "class/one", commands(), None)
    hand_in(tmp_path / "class/small", commands(), (16, 16))
    hand_in(tmp_path / "class/huge", None, b"\x76\x2f\x31\x01" + b"\0" * 500)
    (tmp_path / "class/nothing").mkdir()
    done = run("grade", tmp_path / "class", "--out", tmp_path / "out", "--assignment", "00")
    assert done.returncode == 0, done.stdout + done.stderr
    found = {name: s["modules"][0] for name, s in grades(tmp_path / "out").items()}
    assert {name: (m["verdict"], m["score"]) for name, m in found.items()} == {
        "right": ("pass", 5.0),
        "half": ("fail", 3.0),
        "one": ("fail", 2.0),
        "small": ("fail", 2.0),
        "huge": ("fail", 0.0),
        "nothing": ("missing", 0.0),
    }
    told = {name: " ".join(c["message"] for c in m["checks"]) for name, m in found.items()}
    assert "the command of src/shapes/triangle.c lacks -Isrc" in told["half"]
    assert "first-picture.exr is not in the submission" in told["one"]
    assert "it has 16 x 16 pixels, expected 128 x 128" in told["small"]
    assert "it cannot be read" in told["huge"]
