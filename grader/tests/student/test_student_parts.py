"""The parts of the student's loop, each alone."""

from __future__ import annotations

import os
import threading
import time
from pathlib import Path

import numpy as np
import pytest

from raybook_grader.checks.artefacts import compile_commands_faults, picture_faults
from raybook_grader.checks.unity import read_unity
from raybook_grader.errors import BadInput
from raybook_grader.student.blocks import shrunk
from raybook_grader.student.path_log import first_difference
from raybook_grader.student.project import Project, read_assignments
from raybook_grader.student.shipped import Shipped, nearest, pack_paths, unpack_paths
from raybook_grader.student.testing import run_tests
from raybook_grader.student.watch import watch

# The first step that differs.

LOG = """\
sample 0 through (28.9, 20.4): from (0, 0.987, 3.87) along (-0.0325666, 0.122076, -0.991986)
    hit object 0 (mesh, diffuse) at t = 4.91514, (-0.160069, 1.58702, -1.00575)
      asks light 0 (point): direction (-0.47, 0.55, 0.68)
        gives (0.5, 0.5, 1)
  = (0.5, 0.5, 1)
sample 1 through (28.3, 20.4): from (0, 0.987, 3.87) along (-0.0387033, 0.122558, -0.991706)
    leaves the scene
  = (0, 0, 0)
"""


@pytest.mark.parametrize(
    ("old", "new", "step", "sample", "about"),
    [
        ("t = 4.91514", "t = 4.95", 1, 0, "which object"),
        ("0.55, 0.68", "0.55, -0.68", 2, 0, "the direction to the light"),
        ("gives (0.5, 0.5, 1)", "gives (0, 0, 0)", 3, 0, "what comes of that light"),
        ("object 0", "object 1", 1, 0, "which object"),
        (
            "    leaves the scene",
            "    hit object 2 (rect, diffuse) at t = 1, (0, 0, 0)",
            6,
            1,
            "whether",
        ),
        ("  = (0, 0, 0)\n", "", 7, 1, "the light of the whole path"),
        ("= (0.5, 0.5, 1)", "= (nan, 0.5, 1)", 4, 0, "the light of the whole path"),
    ],
)
def test_first_difference(old: str, new: str, step: int, sample: int, about: str) -> None:
    found = first_difference(LOG.replace(old, new, 1), LOG)
    assert found is not None
    assert (found.step, found.sample) == (step, sample)
    assert found.about.startswith(about)


def test_rounding_is_no_difference() -> None:
    assert first_difference(LOG.replace("4.91514", "4.91523"), LOG) is None
    assert first_difference(LOG, LOG) is None


def test_paths_are_packed_alike_each_time() -> None:
    paths = {(4, 12): LOG, (12, 4): "x"}
    assert unpack_paths(pack_paths(paths)) == paths
    assert pack_paths(paths) == pack_paths(dict(reversed(paths.items())))
    assert nearest(list(paths), (5, 9)) == (4, 12)


# The tests' words.


def program(folder: Path, lines: str) -> Path:
    path = folder / "tests"
    path.write_text(f"#!/bin/sh\n{lines}\n")
    path.chmod(0o755)
    return path


SOURCE = "static void one(void)\n{\n}\n\nstatic void two(void)\n{\n}\n"


@pytest.mark.parametrize(
    ("lines", "stopped"),
    [
        ("echo t.c:2:one:PASS; kill -SEGV $$", "crashed in the test after one (SIGSEGV)"),
        ("echo t.c:2:one:PASS; sleep 60", "did not end within 0.5 s: stuck in the test after one"),
        ("while :; do :; done", "did not end within 0.5 s"),
        ("exit 3", "ended too early, in the first test (exit code 3)"),
        ("echo t.c:2:one:PASS; echo 1 Tests 0 Failures 0 Ignored", ""),
    ],
)
def test_how_the_tests_end(tmp_path: Path, lines: str, stopped: str) -> None:
    (tmp_path / "t.c").write_text(SOURCE)
    run = run_tests(program(tmp_path, f"exec 2>&1\n{lines}"), tmp_path, "t.c", 0.5)
    assert stopped in run.stopped and bool(stopped) == bool(run.stopped)
    assert run.is_right == (not stopped)
    assert run.places == {"one": "t.c:1", "two": "t.c:5"}


def test_stubs_that_the_tests_ran_into(tmp_path: Path) -> None:
    (tmp_path / "t.c").write_text(SOURCE)
    warning = "assignment 03 bvh: not implemented yet, src/accel/bvh.c:22: testing every triangle"
    run = run_tests(program(tmp_path, f"echo '{warning}' >&2"), tmp_path, "t.c", 5)
    assert run.left == ("src/accel/bvh.c:22",)


def test_unity_is_read() -> None:
    said = "a/t.c:12:one:PASS\na/t.c:19:two:FAIL: Expected 1 Was 2. the edge counts\n"
    report = read_unity(said + "-----\n2 Tests 1 Failures 0 Ignored\nFAIL\n")
    assert (report.count, report.failed, report.last) == (2, 1, "two")
    assert str(report.failures[0]) == "two: Expected 1 Was 2. the edge counts"
    assert read_unity("Segmentation fault").count is None


# Files that tools make.

ENTRY = '{"directory": "/d", "file": "src/a.c", "command": "gcc -std=c99 -Isrc -c src/a.c"}'


@pytest.mark.parametrize(
    ("content", "fault"),
    [
        (f"[{ENTRY}]", None),
        (f"[{ENTRY.replace('src/a.c', '/home/s/ray/src/a.c')}]", None),
        ('[{"file": "src/a.c", "arguments": ["cc", "-std=gnu99", "-I", "/x/src"]}]', None),
        ("", "no JSON"),
        ("[" * 100_000, "no JSON"),
        ("{}", "no list"),
        ("[3]", "no list"),
        ("[]", "does not say how src/a.c is compiled"),
        (f"[{ENTRY.replace('src/a.c', 'other/src/aa.c')}]", "does not say how src/a.c"),
        (f"[{ENTRY.replace(' -std=c99', '')}]", "lacks -std=c99"),
        (f"[{ENTRY.replace('-Isrc', '-Isources')}]", "lacks -Isrc"),
        ('[{"file": "src/a.c", "command": 7}]', "no command that can be read"),
        ('[{"file": "src/a.c", "command": "\'"}]', "no command that can be read"),
    ],
)
def test_compile_commands(content: str, fault: str | None) -> None:
    found = compile_commands_faults(content.encode(), ["src/a.c"])
    assert (not found) if fault is None else (fault in found[0])


def test_first_pictures() -> None:
    picture = np.random.default_rng(0).random((20, 30, 3), dtype=np.float32)
    assert picture_faults(picture, (30, 20)) == []
    assert "30 x 20 pixels, expected 20 x 30" in picture_faults(picture, (20, 30))[0]
    assert "shows nothing" in picture_faults(np.zeros_like(picture), (30, 20))[0]
    for bad in (np.nan, np.inf, -1.0):
        broken = picture.copy()
        broken[3, 4, 1] = bad
        assert "NaN, infinite or negative" in picture_faults(broken, (30, 20))[0]


# Watching.


def test_watch_acts_at_once_and_on_every_save(tmp_path: Path) -> None:
    source = tmp_path / "src/a.c"
    source.parent.mkdir()
    source.write_text("1")
    acts: list[str] = []

    def act() -> None:
        acts.append(source.read_text())
        if len(acts) == 1:
            threading.Timer(0.1, save).start()

    def save() -> None:
        # Editors write aside and rename; the clock may not have moved.
        (tmp_path / "src/new").write_text("2")
        (tmp_path / "src/new").replace(source)
        os.utime(source, ns=(0, time.time_ns() + 10**9))

    watch(tmp_path, act, rounds=2)
    assert acts == ["1", "2"]


# Small pictures, and the list of assignments.


def test_shrunk_pictures_keep_their_mean() -> None:
    pixels = np.random.default_rng(1).integers(0, 255, (64, 64, 3)).astype(np.uint8)
    small = shrunk(pixels, 16)
    assert small.shape == (16, 16, 3)
    assert abs(float(small.mean()) - float(pixels.mean())) < 1
    assert shrunk(pixels, 200) is not None and shrunk(pixels, 200).shape == pixels.shape
    assert shrunk(pixels[:, :61], 16).shape[1] <= 16


def test_numbers_may_be_short() -> None:
    root = Path(__file__).resolve().parents[3]
    project = Project(root, read_assignments(root), Shipped(root))
    assert [a.number for a in project.chosen("1, 03")] == ["01", "03"]
    assert len(project.chosen("")) == len(project.assignments)
    with pytest.raises(BadInput, match="A=99: no such assignment"):
        project.chosen("99")
