"""The command line: what it prints, its exit codes, and one command from archives to exports."""

from __future__ import annotations

from pathlib import Path

import pytest
from small_gradebook import COURSE, broken, class_of, right

from raybook_grader.cli import parser
from raybook_grader.errors import BadInput
from raybook_grader.exports.commands import check_exports, export_list, write_exports


def run(*arguments: str | Path) -> int:
    parsed = parser().parse_args([str(argument) for argument in arguments])
    return int(parsed.handler(parsed))


def test_unknown_scores_are_counted_and_make_exit_3(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    class_of(tmp_path, {"a": (right(),), "b\x1b[2J": (broken(),)}).close()
    assert run("export", tmp_path, "--format", "csv") == 3
    said = capsys.readouterr().out
    assert "no score, so left empty: 1" in said and "01 triangle" in said
    assert "\x1b" not in said


def test_all_known_is_exit_0(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    class_of(tmp_path, {"a": (right(),)}).close()
    file = tmp_path / "mine.csv"
    assert run("export", tmp_path, "--format", "csv", "--output", file) == 0
    assert file.is_file() and "left empty" not in capsys.readouterr().out


def test_no_results_are_bad_input(tmp_path: Path) -> None:
    with pytest.raises(BadInput, match="expected a folder that `grade` has written"):
        run("export", tmp_path, "--format", "csv")


def test_grade_takes_a_list_of_exports(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    parsed = parser().parse_args(
        ["grade", "class", "--out", "grades", "--export", "csv,json,gradescope,canvas"]
    )
    assert [request.format for request in parsed.export] == ["csv", "json", "gradescope", "canvas"]
    class_of(tmp_path, {"a": (right(),)}).close()
    assert write_exports(tmp_path, COURSE, parsed.export)
    names = sorted(path.name for path in (tmp_path / "exports").iterdir())
    assert names == ["canvas.csv", "grades.csv", "grades.json", "gradescope"]
    assert "canvas: " in capsys.readouterr().out


def test_a_bad_list_fails_before_anything_is_graded(tmp_path: Path) -> None:
    with pytest.raises(SystemExit):
        parser().parse_args(["grade", "class", "--out", "grades", "--export", "excel"])
    with pytest.raises(BadInput, match="needs a roster"):
        check_exports(export_list("csv,moodle"))
    with pytest.raises(BadInput, match="expected a class list"):
        check_exports(export_list(f"canvas={tmp_path / 'nowhere.csv'}"))


def test_one_that_cannot_be_written_does_not_stop_the_others(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    class_of(tmp_path, {"a": (right(),)}).close()
    roster = tmp_path / "roster.csv"
    roster.write_text("Student,ID,Section,01 triangle (3)\n    Points Possible,,,7\nA,a,S,\n")
    assert not write_exports(tmp_path, COURSE, export_list(f"canvas={roster},csv"))
    assert "canvas: not written: " in capsys.readouterr().out
    assert (tmp_path / "exports" / "grades.csv").is_file()
