"""Canvas and Moodle: our scores in their files, at the right person, and nothing else changed."""

from __future__ import annotations

import csv
import io
from pathlib import Path

import pytest
from small_gradebook import COURSE, FORMULA, broken, class_of, right, stub, wrong

from raybook_grader.database import Database
from raybook_grader.errors import BadInput
from raybook_grader.exports import Request, Written, write_export

CANVAS = """\
Student,ID,SIS User ID,SIS Login ID,Section,01 About triangle (4711),Essay (12),Final Score
,,,,,Manual Posting,,
    Points Possible,,,,,10.00,20.00,(read only)
"Arnold, Anna",1001,u1,anna@uni.example,A1,,15.00,80
"Berg, Bo",1002,u2,bo,A1,3.00,,50
"=cmd|' /C calc'!A0",1003,u3,carl,A1,,,0
"Dahl, Dora",1004,u4,dora,A1,,,0
"Student, Test",1005,,f00ba4,A1,,,
"""

MOODLE = (
    "\ufeffIdentifier,Full name,Email address,Status,Grade,Maximum Grade,Grade can be changed,"
    "Last modified (submission),Last modified (grade),Feedback comments\n"
    'Participant 501,Anna Arnold,anna@uni.example,Submitted,,10.00,Yes,"Monday, 2 March 2026",-,\n'
    "Participant 502,Bo Berg,bo@uni.example,Submitted,3.00,10.00,Yes,-,-,old words\n"
    "Participant 503,=Carl,carl@uni.example,Submitted,2.00,10.00,Yes,-,-,older words\n"
    "Participant 504,Dora Dahl,dora@uni.example,No submission,,10.00,Yes,-,-,\n"
)


@pytest.fixture
def database(tmp_path: Path) -> Database:
    return class_of(
        tmp_path,
        {"anna": (right(), wrong()), "BO": (wrong("<b>&"), stub()), "carl": (broken(), right()),
         "zoe": (right(), right())},
    )  # fmt: skip


def roster(tmp_path: Path, text: str) -> Path:
    file = tmp_path / ("worksheet.csv" if "Identifier" in text else "gradebook.csv")
    file.write_text(text, encoding="utf-8")
    return file


def export(database: Database, folder: Path, request: Request) -> tuple[Written, list[list[str]]]:
    written = write_export(database, folder, COURSE, request)
    text = written.path.read_bytes().decode("utf-8")
    return written, list(csv.reader(io.StringIO(text, newline="")))


def test_canvas_gets_each_score_at_its_student(tmp_path: Path, database: Database) -> None:
    request = Request("canvas", roster=roster(tmp_path, CANVAS))
    written, (header, points, *students) = export(database, tmp_path, request)
    assert header == ["Student", "ID", "SIS User ID", "SIS Login ID", "Section",
                      "01 About triangle (4711)", "02 About aabb"]  # fmt: skip
    assert points == ["    Points Possible", "", "", "", "", "10.00", "10"]
    by_id = {row[1]: row for row in students}
    assert by_id["1001"] == ["Arnold, Anna", "1001", "u1", "anna@uni.example", "A1", "10", "4"]
    assert by_id["1002"][5:] == ["4", "0"]
    assert by_id["1003"][5:] == ["", "10"], "an unknown score is empty, never zero"
    assert by_id["1003"][0] == "'=cmd|' /C calc'!A0"
    assert by_id["1004"][5:] == by_id["1005"][5:] == ["", ""]
    assert any("zoe: not in the class list" in note for note in written.notes)
    assert any("02 About aabb" in note for note in written.notes)
    assert written.unknown == ["carl: 01 triangle"]


def test_canvas_without_a_roster_goes_by_login(tmp_path: Path, database: Database) -> None:
    _, (header, points, *students) = export(database, tmp_path, Request("canvas"))
    assert header[:5] == ["Student", "ID", "SIS User ID", "SIS Login ID", "Section"]
    assert points[0] == "    Points Possible"
    assert [row[3] for row in students] == ["BO", "anna", "carl", "zoe"]
    assert [row[5] for row in students] == ["4", "10", "", "10"]


def test_canvas_knows_the_names_of_its_downloads(tmp_path: Path) -> None:
    database = class_of(
        tmp_path,
        {"arnoldanna_1001_98765_raybook": (right(),), "bergbo_LATE_1002_98766_my_work": (wrong(),)},
    )
    request = Request("canvas", roster=roster(tmp_path, CANVAS), assignments=["01"])
    written, (_, _, *students) = export(database, tmp_path, request)
    assert [row[5] for row in students[:2]] == ["10", "4"]
    assert not any("not in the" in note for note in written.notes)


def test_two_submissions_of_one_student_are_told_not_chosen(tmp_path: Path) -> None:
    database = class_of(tmp_path, {"anna": (right(),), "u1": (stub(),), "bo": (right(),)})
    request = Request("canvas", roster=roster(tmp_path, CANVAS), assignments=["01"])
    written, (_, _, *students) = export(database, tmp_path, request)
    assert students[0][5] == "" and students[1][5] == "10"
    assert sum("another submission is the same student's" in n for n in written.notes) == 2


def test_a_name_that_fits_two_students_is_told(tmp_path: Path) -> None:
    twice = CANVAS.replace("1004,u4,dora", "1004,bo,dora")
    database = class_of(tmp_path, {"bo": (right(),)})
    written, (_, _, *students) = export(
        database, tmp_path, Request("canvas", roster=roster(tmp_path, twice), assignments=["01"])
    )
    assert {row[5] for row in students} == {""}
    assert any("bo: fits 2 rows" in note for note in written.notes)
    _, (_, _, *students) = export(
        database,
        tmp_path,
        Request("canvas", roster=roster(tmp_path, twice), key="SIS Login ID", assignments=["01"]),
    )
    assert [row[5] for row in students] == ["", "10", "", "", ""]


def test_a_column_of_another_name_is_used_when_told(tmp_path: Path, database: Database) -> None:
    request = Request(
        "canvas", roster=roster(tmp_path, CANVAS), columns={"02": "Essay"}, scale=True
    )
    _, (header, points, *students) = export(database, tmp_path, request)
    assert header[6] == "Essay (12)" and points[6] == "20.00"
    assert students[0][6] == "8", "4 of 10 are 8 of 20"


def test_other_points_there_are_an_error(tmp_path: Path, database: Database) -> None:
    other = CANVAS.replace("10.00,20.00", "25.00,20.00")
    with pytest.raises(BadInput, match="25 points there and 10 here"):
        export(database, tmp_path, Request("canvas", roster=roster(tmp_path, other)))
    request = Request("canvas", roster=roster(tmp_path, other), scale=True)
    _, (_, _, *students) = export(database, tmp_path, request)
    assert students[0][5] == "25" and students[1][5] == "10"


def test_a_semicolon_file_stays_one(tmp_path: Path, database: Database) -> None:
    file = tmp_path / "semicolons.csv"
    with file.open("w", newline="", encoding="utf-8") as stream:
        csv.writer(stream, delimiter=";").writerows(csv.reader(io.StringIO(CANVAS)))
    written = write_export(database, tmp_path, COURSE, Request("canvas", roster=file))
    text = written.path.read_text(encoding="utf-8")
    assert len(text.splitlines()[0].split(";")) == 7


@pytest.mark.parametrize(
    "text, words",
    [("", "is empty"), ("Name,Points\na,1\n", "expected 'Student'"),
     ("Student,ID,Section\na,1,2,3\n", "row 2 has 4 cells"),
     ("Student,ID\na,1\n", "no column 'Section'"), ('Student,"ID\n', "expected CSV")],
)  # fmt: skip
def test_a_roster_that_is_none_is_told(
    tmp_path: Path, database: Database, text: str, words: str
) -> None:
    with pytest.raises(BadInput, match=words):
        export(database, tmp_path, Request("canvas", roster=roster(tmp_path, text)))


def test_moodle_gets_grade_and_words(tmp_path: Path, database: Database) -> None:
    request = Request("moodle", roster=roster(tmp_path, MOODLE))
    written, (header, anna, bo, carl, dora) = export(database, tmp_path, request)
    assert header[0] == "Identifier" and header[4] == "Grade"
    assert anna[:5] == ["Participant 501", "Anna Arnold", "anna@uni.example", "Submitted", "10"]
    assert anna[7:9] == ["Monday, 2 March 2026", "-"]
    assert bo[4] == "4"
    assert "01 triangle: 4 of 10, fail. Not passed: edge cases" in bo[9]
    assert "<b>" not in bo[9]
    assert carl[4] == "", "unknown: Moodle leaves the grade as it is"
    assert carl[9] == "older words"
    assert carl[1] == "'=Carl"
    assert dora[4] == "" and dora[9] == ""
    assert any("zoe: not in the class list" in note for note in written.notes)
    assert written.unknown == ["carl: 01 triangle"]


def test_moodle_knows_the_names_of_its_downloads(tmp_path: Path) -> None:
    database = class_of(tmp_path, {"Bo Berg_502_assignsubmission_file_": (right(),)})
    _, (_, anna, bo, *_) = export(
        database, tmp_path, Request("moodle", roster=roster(tmp_path, MOODLE))
    )
    assert (anna[4], bo[4]) == ("", "10")


def test_moodle_drops_too_high_grades_so_other_maxima_are_an_error(
    tmp_path: Path, database: Database
) -> None:
    file = roster(tmp_path, MOODLE.replace(",10.00,", ",8.00,"))
    with pytest.raises(BadInput, match="8 points there and 10 here"):
        export(database, tmp_path, Request("moodle", roster=file))
    _, (_, anna, *_) = export(database, tmp_path, Request("moodle", roster=file, scale=True))
    assert anna[4] == "8"


def test_moodle_needs_its_worksheet(tmp_path: Path, database: Database) -> None:
    with pytest.raises(BadInput, match="roster"):
        write_export(database, tmp_path, COURSE, Request("moodle"))
    without = MOODLE.replace("Last modified (grade)", "Other")
    with pytest.raises(BadInput, match="Last modified"):
        write_export(
            database, tmp_path, COURSE, Request("moodle", roster=roster(tmp_path, without))
        )


def test_nothing_in_any_file_runs(tmp_path: Path) -> None:
    database = class_of(tmp_path, {FORMULA: (wrong(FORMULA), right()), "carl": (right(), right())})
    for request in (
        Request("csv"),
        Request("canvas"),
        Request("canvas", roster=roster(tmp_path, CANVAS)),
        Request("moodle", roster=roster(tmp_path, MOODLE)),
    ):
        _, lines = export(database, tmp_path, request)
        for cell in (cell for line in lines for cell in line):
            assert cell == "-" or not cell.startswith(("=", "+", "-", "@", "\t", "\r")), cell
