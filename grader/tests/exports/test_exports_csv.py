"""Tables: what a spreadsheet could run is text, numbers are numbers, unknown is empty."""

from __future__ import annotations

import csv
import io
import json
from pathlib import Path

import pytest
from small_gradebook import COURSE, FORMULA, broken, class_of, right, stub, wrong

from raybook_grader.errors import BadInput
from raybook_grader.exports import Request, gradebook, write_export
from raybook_grader.exports.cells import cell, table
from raybook_grader.exports.gradebook import read_gradebook
from raybook_grader.grading.export import grades


@pytest.mark.parametrize(
    "text",
    ["=1+1", "+1+1", "-1+1", "@SUM(A1)", "\t=1", "\r=1", "\n=1", " =1", "=", FORMULA,
     "-2+3+cmd|' /C calc'!A0", "\uff1d1", "--1", "1-"[::-1] + "-"],
)  # fmt: skip
def test_what_looks_like_a_formula_gets_an_apostrophe(text: str) -> None:
    assert cell(text) == f"'{text}"


@pytest.mark.parametrize(
    "value, expected",
    [(-2.5, "-2.5"), (0.0, "0"), (-0.001, "0"), (87.5, "87.5"), (1e6, "1000000"), (None, ""),
     ("-2.5", "-2.5"), ("+3", "+3"), ("-", "-"), ("s042", "s042"), ("a=b", "a=b"), ("", "")],
)  # fmt: skip
def test_numbers_and_plain_words_stay(value: str | float | None, expected: str) -> None:
    assert cell(value) == expected


def test_a_cell_cannot_end_itself() -> None:
    evil = 'a",=1+1,"b\r\n=2;=3'
    (row,) = csv.reader(io.StringIO(table([[evil, "next"]]), newline=""))
    assert row == [evil, "next"]
    # For a program that takes semicolons for separators, the quotes hold, too.
    (row,) = csv.reader(io.StringIO(table([["x;=1+1", "y"]])), delimiter=";")
    assert not any(part.startswith(("=", "+", "@")) for part in row)


def rows(text: str) -> list[dict[str, str]]:
    return list(csv.DictReader(io.StringIO(text, newline="")))


def test_each_submission_has_a_row_and_unknown_is_empty(tmp_path: Path) -> None:
    database = class_of(
        tmp_path,
        {"a": (right(), wrong()), FORMULA: (wrong(), stub()), "b": (broken(), right()),
         "c": (None, right())},
    )  # fmt: skip
    written = write_export(database, tmp_path, COURSE, Request("csv"))
    assert written.path == tmp_path / "exports" / "grades.csv"
    found = {row["submission"]: row for row in rows(written.path.read_text(encoding="utf-8"))}
    assert set(found) == {"a", f"'{FORMULA}", "b", "c"}
    assert found["a"]["score"] == "10" and found["a"]["02 aabb"] == "4"
    assert found["a"]["02 aabb verdict"] == "fail"
    assert found[f"'{FORMULA}"]["02 aabb"] == "0"
    assert found["b"]["score"] == found["b"]["01 triangle"] == ""
    assert found["b"]["01 triangle verdict"] == "internal-error"
    assert found["c"]["score"] == found["c"]["01 triangle"] == ""
    assert written.unknown == ["b: 01 triangle", "c: not graded to the end"]


def test_naming_modules_sums_them_up(tmp_path: Path) -> None:
    database = class_of(tmp_path, {"a": (right(), wrong()), "b": (broken(), right())})
    book = read_gradebook(database, ["01", "02"])
    assert [(row.score, row.max_score) for row in book.rows] == [(14, 20), (None, 20)]
    only = read_gradebook(database, ["02"])
    assert [row.score for row in only.rows] == [4, 10]
    assert not only.unknown
    with pytest.raises(BadInput, match="never graded here"):
        read_gradebook(database, ["07"])


def test_grades_from_without_a_sandbox_are_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    database = class_of(tmp_path, {"a": (right(), wrong()), "b": (right(),)})
    assert not write_export(database, tmp_path, COURSE, Request("csv")).notes
    values = grades(database)
    values["submissions"][0]["modules"][1]["unsafe"] = True
    monkeypatch.setattr(gradebook, "grades", lambda database: values)
    notes = write_export(database, tmp_path, COURSE, Request("csv")).notes
    assert notes == ["graded without a sandbox, so nothing to rely on: 1 modules"]


def test_json_is_grades_json(tmp_path: Path) -> None:
    database = class_of(tmp_path, {"a": (right(),), "b": (broken(),)})
    written = write_export(database, tmp_path, COURSE, Request("json"))
    values = json.loads(written.path.read_text(encoding="utf-8"))
    assert values == json.loads((tmp_path / "grades.json").read_text(encoding="utf-8"))
    assert [s["score"] for s in values["submissions"]] == [10, None]


def test_a_place_that_cannot_be_written_is_told(tmp_path: Path) -> None:
    database = class_of(tmp_path, {"a": (right(),)})
    with pytest.raises(BadInput, match="expected a file that can be written"):
        write_export(database, tmp_path, COURSE, Request("csv", tmp_path / "no" / "where.csv"))
