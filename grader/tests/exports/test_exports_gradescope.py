"""Gradescope's results.json: valid, total on top, secrets late, no score where none is known."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import jsonschema
import pytest
from small_gradebook import COURSE, SECRET, broken, class_of, right, stub, wrong

from raybook_grader.course import Course
from raybook_grader.database import Database
from raybook_grader.errors import BadInput
from raybook_grader.exports import Request, write_export

SCHEMA = json.loads(Path(__file__).with_name("gradescope.schema.json").read_text())


@pytest.fixture
def database(tmp_path: Path) -> Database:
    return class_of(
        tmp_path,
        {"good": (right(), right()), "bad": (wrong(), stub()), "../ours": (right(), broken()),
         "ours": (broken(), right())},
    )  # fmt: skip


def exported(database: Database, folder: Path, course: Course = COURSE) -> dict[str, Any]:
    written = write_export(database, folder, course, Request("gradescope"))
    found = {
        file.parent.name: json.loads(file.read_text(encoding="utf-8"))
        for file in written.path.glob("*/results.json")
    }
    for values in found.values():
        jsonschema.validate(values, SCHEMA)
    return found


def test_each_submission_has_a_valid_file(tmp_path: Path, database: Database) -> None:
    found = exported(database, tmp_path)
    assert len(found) == 4
    assert found["good"]["score"] == 10, "the required modules; the optional one is extra"
    assert [test["score"] for test in found["bad"]["tests"]] == [4, 0, 0]
    assert [test["status"] for test in found["bad"]["tests"]] == ["passed", "failed", "failed"]
    assert found["bad"]["tests"][2]["max_score"] == 10
    assert not (tmp_path / "ours").exists() and not (tmp_path / "exports" / "ours").exists()


def test_hidden_checks_wait_and_open_ones_do_not(tmp_path: Path, database: Database) -> None:
    tests = exported(database, tmp_path)["bad"]["tests"]
    assert [test["visibility"] for test in tests] == ["visible", "after_published", "visible"]
    told = [test["output"] for test in tests if test["visibility"] == "visible"]
    values = exported(database, tmp_path)["bad"]
    assert SECRET not in values["output"] and not any(SECRET in words for words in told)
    assert values["output_format"] == "text" and values["stdout_visibility"] == "hidden"


def test_what_the_course_does_not_know_is_hidden(tmp_path: Path, database: Database) -> None:
    found = exported(database, tmp_path, Course(Path(), "Another", ()))
    checks = [test for test in found["good"]["tests"]]
    assert {test["visibility"] for test in checks} == {"after_published"}


def test_without_a_known_total_no_score_is_anywhere(tmp_path: Path, database: Database) -> None:
    values = exported(database, tmp_path)["ours"]
    assert "score" not in values
    assert all("score" not in test and "max_score" not in test for test in values["tests"])
    assert "no score yet" in values["output"]


def test_one_submission_goes_into_one_file(tmp_path: Path, database: Database) -> None:
    file = tmp_path / "results.json"
    request = Request("gradescope", file, submission="bad", hidden="hidden")
    write_export(database, tmp_path, COURSE, request)
    values = json.loads(file.read_text())
    jsonschema.validate(values, SCHEMA)
    assert values["tests"][1]["visibility"] == "hidden"
    with pytest.raises(BadInput, match="no submission"):
        write_export(database, tmp_path, COURSE, Request("gradescope", file, submission="nobody"))
