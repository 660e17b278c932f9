"""The commands: what they print and their exit codes."""

from __future__ import annotations

import argparse
from pathlib import Path

import pytest
from literate_project import DISC_C_STUDENT, write_project

from raybook_grader.literate.__main__ import main
from raybook_grader.literate.commands import add_commands

SOLUTION = "return x * x + y * y <= radius * radius;"


def run(*words: str) -> int:
    """A command of raybook-grader."""
    parser = argparse.ArgumentParser()
    add_commands(parser.add_subparsers())
    arguments = parser.parse_args(words)
    code: int = arguments.handler(arguments)
    return code


@pytest.fixture
def root(tmp_path: Path) -> str:
    return str(write_project(tmp_path / "checkout"))


def test_check(root: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert run("literate-check", "--root", root) == 0
    assert capsys.readouterr().out == "3 files, 9 fragments, 2 exercises: no violation\n"


def test_check_prints_every_violation(root: str, capsys: pytest.CaptureFixture[str]) -> None:
    Path(root, "src/bad.c").write_text("\ta\n//< x\n")
    assert run("literate-check", "--root", root) == 1
    lines = capsys.readouterr().out.splitlines()
    assert [line[:12] for line in lines] == ["src/bad.c:1:", "src/bad.c:2:"]


def test_check_without_a_source(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run("literate-check", "--root", str(tmp_path)) == 2
    assert "src: no such folder" in capsys.readouterr().err


def test_leaks(root: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    page = tmp_path / "page.html"
    page.write_text("<p>harmless</p>")
    assert run("literate-leaks", "--root", root, str(page)) == 0
    page.write_text(SOLUTION)
    assert run("literate-leaks", "--root", root, str(page)) == 1
    assert f"LEAK src/shapes/disc.c:10 in page.html:1: {SOLUTION}" in capsys.readouterr().out
    assert run("literate-leaks", "--root", root, "--reveal", "01", str(page)) == 0


def test_leaks_in_what_cannot_be_read(
    root: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "a.zip").write_bytes(b"PK\x03\x04broken")
    assert run("literate-leaks", "--root", root, str(tmp_path / "a.zip")) == 1
    assert "NOT SEARCHED a.zip: BadZipFile" in capsys.readouterr().out


def test_leaks_of_nothing(root: str, tmp_path: Path) -> None:
    assert run("literate-leaks", "--root", root, str(tmp_path / "nowhere")) == 2


def test_handout(root: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = tmp_path / "out"
    words = ["handout", str(out), "--root", root]
    assert run(*words, "--assignment", "01", "--reveal", "01,02") == 0
    assert capsys.readouterr().out == f"{out}: 15 files, no leak\n"
    assert not (out / "assignments/02-mean").exists()
    assert SOLUTION in (out / "src/shapes/disc.c").read_text()


def test_handout_that_would_leak(
    root: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    Path(root, "scenes/a.txt").write_text(SOLUTION)
    assert run("handout", str(tmp_path / "out"), "--root", root) == 1
    assert "LEAK src/shapes/disc.c:10 in scenes/a.txt:1" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


def test_handout_of_bad_usage(
    root: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["handout", str(tmp_path / "out"), "--root", root]
    assert run(*words, "--assignment", "9") == 2
    assert "no assignment '9'" in capsys.readouterr().err
    Path(root, "src/shapes/mean.c").write_text("//< x\n")
    assert run(*words) == 1
    assert "src/shapes/mean.c:1: //< x closes nothing" in capsys.readouterr().err


def test_todos(root: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["todos", "--root", root]) == 0
    assert capsys.readouterr().out.splitlines() == [
        "disc_hit  src/shapes/disc.c:20  01",
        "mean_pair  src/shapes/mean.c:4  02",
    ]


def test_student(root: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["student", "--root", root, "src/shapes/disc.c"]) == 0
    assert capsys.readouterr().out == DISC_C_STUDENT
    assert main(["student", "--root", root, "src/none.c"]) == 2
