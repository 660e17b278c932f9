"""Decisions by hand: with a reason, final, kept for ever, shown everywhere."""

from __future__ import annotations

import csv
import shutil
from pathlib import Path

import pytest
from policy_fixtures import Command
from policy_fixtures import course as course
from policy_fixtures import grade as grade
from policy_fixtures import grader as grader
from tiny_course import grades, hand_in, modules

EVIL = "<script>alert('x')</script>\x1b[31m"


@pytest.fixture
def out(tmp_path: Path, grade: Command) -> Path:
    hand_in(tmp_path / "class", "s1", {"01": "a"})
    hand_in(tmp_path / "class", "s2", {"01": "ab"})
    assert grade().code == 0
    return tmp_path / "out"


def test_it_is_final_and_shown(out: Path, grader: Command) -> None:
    done = grader("override", out, "s1", "01", "7.5", "--reason", EVIL, "--by", "A. Meier")
    assert done.code == 0, done.err
    assert "1. s1 01: 7.5 points, by A. Meier" in done.out and "\x1b" not in done.out
    module = modules(out, "s1")["01"]
    assert (module["score"], module["raw_score"], module["verdict"]) == (7.5, 4, "fail")
    override = module["override"]
    assert (override["score"], override["reason"], override["by"]) == (7.5, EVIL, "A. Meier")
    assert override["at"].startswith("20")
    assert grades(out)["s1"]["score"] == 7.5
    page = (out / "students" / "s1.html").read_text()
    assert "Set to 7.5 points by A. Meier; the grader found 4 points." in page
    assert "<script>alert" not in page and "&lt;script&gt;alert" in page
    assert "set by hand" in (out / "index.html").read_text()
    assert grader("export", out, "--format", "csv", "--output", out / "x.csv").code == 0
    assert next(csv.reader((out / "x.csv").open(newline="").readlines()[1:]))[:2] == ["s1", "7.5"]


def test_it_survives_everything(out: Path, grader: Command, grade: Command) -> None:
    assert grader("override", out, "s1", "01", "9", "--reason", "r", "--by", "b").code == 0
    for arguments in (("--regrade", "all"), ("--regrade", "s1", "--apply"), ("--fresh",)):
        assert grade(*arguments).code == 0
        assert modules(out, "s1")["01"]["score"] == 9
    shutil.move(out.parent / "class" / "s1", out.parent / "away")
    assert grade("--apply").code == 0
    assert "(has no submission now)" in grader("override", out, "--list").out
    shutil.move(out.parent / "away", out.parent / "class" / "s1")
    assert grade().code == 0
    assert modules(out, "s1")["01"]["score"] == 9


def test_a_withdrawal_is_one_more_entry(out: Path, grader: Command) -> None:
    for points in ("9", "8"):
        assert grader("override", out, "s1", "01", points, "--reason", "r", "--by", "b").code == 0
    done = grader("override", out, "--withdraw", "2", "--reason", "wrong", "--by", "c")
    assert done.code == 0 and "s1 01: 9 points now" in done.out
    assert grader("override", out, "--withdraw", "1", "--reason", "also", "--by", "c").code == 0
    assert modules(out, "s1")["01"]["score"] == 4 and modules(out, "s1")["01"]["override"] is None
    lines = grader("override", out, "--list").out.splitlines()
    assert [line.split(",")[0] for line in lines] == [
        "1. s1 01: 9 points (no longer holds)",
        "2. s1 01: 8 points (no longer holds)",
        "3. s1 01: withdraws 2",
        "4. s1 01: withdraws 1",
    ]


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("s1", "01", "7"), "--reason is missing"),
        (("s1", "01", "7", "--reason", "  "), "--reason is missing"),
        (("s1", "01", "--reason", "r"), "too few arguments"),
        (("s9", "01", "7", "--reason", "r"), "no student 's9'"),
        (("s1", "09", "7", "--reason", "r"), "no assignment '09', expected 01, 02, 03"),
        (("s1", "01", "11", "--reason", "r"), "POINTS is 11, expected a number from 0 to 10"),
        (("s1", "01", "nan", "--reason", "r"), "POINTS is nan"),
        (("s1", "01", "many", "--reason", "r"), "POINTS is 'many'"),
        (("--withdraw", "5", "--reason", "r"), "no decision of that number"),
        (("s1", "--withdraw", "5", "--reason", "r"), "takes no STUDENT"),
    ],
)
def test_faults(out: Path, grader: Command, arguments: tuple[str, ...], words: str) -> None:
    done = grader("override", out, *arguments)
    assert done.code == 2 and words in done.err
    assert grader("override", out, "--list").out == "nothing was ever decided by hand\n"


def test_a_folder_without_grades(tmp_path: Path, grader: Command) -> None:
    done = grader("override", tmp_path / "none", "--list")
    assert done.code == 2 and not (tmp_path / "none").exists()
