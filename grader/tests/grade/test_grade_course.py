"""Reading the rubric: what it says is what it holds, and each fault is one message."""

from __future__ import annotations

from pathlib import Path

import pytest
from make_class import CHECKOUT

from raybook_grader.course import ImageCheck, load_course
from raybook_grader.errors import BadInput

RUBRIC = """
number = "01"
module = "triangle"
title = "Ray-triangle intersection"
points = 3
owned = ["src/shapes/triangle.c"]

[[check]]
name = "compiles"
kind = "build"
points = 1

[[check]]
name = "picture"
kind = "image"
points = 2
scene = "scenes/a.json"
resolution = "128x64"
spp = 16
seeds = 8
hidden = true
"""


def course(root: Path, rubric: str) -> Path:
    for file, text in {
        "assignments/01-triangle/assignment.toml": rubric,
        "assignments/01-triangle/test.c": "",
        "src/shapes/triangle.c": "",
        "scenes/a.json": "{}",
    }.items():
        (root / file).parent.mkdir(parents=True, exist_ok=True)
        (root / file).write_text(text, encoding="utf-8")
    return root


def test_a_rubric_is_read(tmp_path: Path) -> None:
    loaded = load_course(course(tmp_path, RUBRIC))
    assignment = loaded.assignment("01")
    assert assignment.is_graded and not assignment.optional
    assert assignment.limits.wall_seconds == 20
    _, picture = assignment.checks
    assert picture == ImageCheck("picture", 2.0, "scenes/a.json", (128, 64), 16, 8, True)


def test_without_checks_it_is_not_graded_yet(tmp_path: Path) -> None:
    rubric = RUBRIC.split("[[check]]")[0].replace("triangle.c", "not-written.c")
    assert not load_course(course(tmp_path, rubric)).assignment("01").is_graded


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("points = 3", "points = 4", "points: is 4, expected the checks' sum, 3"),
        ("points = 3", "", "points: is missing, expected a number above 0"),
        ("points = 3", "points = true", "points: is True"),
        ("points = 3", "points = inf", "points: is inf"),
        ('number = "01"', 'number = "1"', "two digits"),
        ('title = "R', 'titel = "R', "title: is missing"),
        ("spp = 16", "spp = 16\nsamples = 3", "check 2, samples: is no key of this table"),
        ("spp = 16", "ssp = 16", "check 2, spp: is missing"),
        ("spp = 16", "spp = 0", "check 2, spp: is 0, expected a whole number, at least 1"),
        ("spp = 16", "spp = 1.5", "check 2, spp: is 1.5"),
        ('"128x64"', '"128"', "like 128x128"),
        ('"scenes/a.json"', '"scenes/b.json"', "a file that exists"),
        ('"scenes/a.json"', '"../scenes/a.json"', "a plain path"),
        ('kind = "image"', 'kind = "images"', "expected one of build, unit, probe, statistics"),
        ('kind = "build"', 'kind = "unit"\ntests = "test.c"', "0 of kind 'build'"),
        ('name = "picture"', 'name = "compiles"', "two are called 'compiles'"),
        ('["src/shapes/triangle.c"]', "[]", "owned: is empty"),
        ('["src/shapes/triangle.c"]', '["src/no.c"]', "a file that exists"),
        ('["src/shapes/triangle.c"]', '"src"', "a list of different texts"),
        ('["src/shapes/triangle.c"]', '["a", "a"]', "a list of different texts"),
        ("\n[[check]]", "[limits]\nwal_seconds = 1\n[[check]]", "limits, wal_seconds"),
        ("title =", "title", "expected TOML"),
    ],
)
def test_faults_say_where_and_what(tmp_path: Path, old: str, new: str, words: str) -> None:
    assert old in RUBRIC
    with pytest.raises(BadInput) as fault:
        load_course(course(tmp_path, RUBRIC.replace(old, new, 1)))
    assert words in str(fault.value)
    assert "assignment.toml" in str(fault.value)


def test_two_assignments_share_nothing(tmp_path: Path) -> None:
    other = course(tmp_path, RUBRIC) / "assignments" / "02-aabb" / "assignment.toml"
    other.parent.mkdir()
    other.write_text(RUBRIC.replace('"01"', '"02"'), encoding="utf-8")
    with pytest.raises(BadInput, match=r"src/shapes/triangle\.c is also in"):
        load_course(tmp_path)


def test_a_folder_without_assignments(tmp_path: Path) -> None:
    with pytest.raises(BadInput, match="a checkout of the course"):
        load_course(tmp_path)


def test_our_own_rubrics() -> None:
    assert load_course(CHECKOUT).assignment("01").points == 10
