"""What goes wrong with the harness or its user, not with a submission."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest
from make_class import OWNED, solution
from small_course import FOLDER, checks, done, grades, run, small_course, write_submissions

from raybook_grader.cli import main


@pytest.fixture(scope="module")
def one(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_submissions(tmp_path_factory.mktemp("one"), {"s01": solution()}, OWNED)


@pytest.fixture(scope="module")
def course(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return small_course(tmp_path_factory.mktemp("course") / "course")


def test_a_broken_oracle_is_no_zero(one: Path, tmp_path: Path) -> None:
    course = small_course(tmp_path / "course")
    oracle = course / FOLDER / "hidden" / "oracle_differentials.py"
    whole = oracle.read_text(encoding="utf-8")
    oracle.write_text(
        whole + "\ndef make_cases(group, seed):\n    raise RuntimeError('<broken>')\n"
    )
    arguments = ("grade", one, "--out", tmp_path / "out", "--course", course)

    ended = run(*arguments)
    assert ended.returncode == 3
    submission = grades(tmp_path / "out")["s01"]
    assert submission["score"] is None
    (module,) = submission["modules"]
    assert (module["verdict"], module["score"]) == ("internal-error", None)
    statuses = {check["name"]: check["status"] for check in checks(submission)}
    assert statuses["texture differentials"] == "internal-error"
    assert statuses["edge cases"] == "passed"
    index = (tmp_path / "out" / "index.html").read_text(encoding="utf-8")
    assert "RuntimeError: &lt;broken&gt;" in index
    for page in (tmp_path / "out" / "students").rglob("*.html"):
        assert "broken" not in page.read_text(encoding="utf-8")

    assert run(*arguments).returncode == 3, "it is tried again, and fails again"
    oracle.write_text(whole)
    assert run(*arguments).returncode == 0
    assert grades(tmp_path / "out")["s01"]["modules"][0]["verdict"] == "pass"


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("grade",), "SUBMISSIONS"),
        (("grade", "/nowhere", "--out", "OUT"), "/nowhere: No such file"),
        (("grade", "ONE"), "--out"),
        (("grade", "ONE", "--out", "OUT", "--assignment", "99"), "no assignment '99'"),
        (("grade", "ONE", "--out", "OUT", "--assignment", ","), "--assignment"),
        (("grade", "ONE", "--out", "OUT", "--jobs", "0"), "--jobs"),
        (("grade", "ONE", "--out", "OUT", "--regrade", "s77"), "--regrade 's77'"),
        (("grade", "ONE", "--out", "OUT", "--course", "/nowhere"), "expected a checkout"),
        (("grade", "ONE", "--out", "OUT", "--kit", "/nowhere"), "make kit"),
        (("grade", "EMPTY", "--out", "OUT"), "no submission"),
        (("grade", "ONE", "--out", "FILE/x"), "expected a folder"),
        (("report", "EMPTY"), "grades.sqlite"),
        (("grade", "ONE", "--out", "OUT", "--colour"), "--colour"),
        (("paint",), "paint"),
    ],
)
def test_bad_usage_is_one_message(
    arguments: tuple[str, ...],
    words: str,
    one: Path,
    course: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    (tmp_path / "EMPTY").mkdir()
    (tmp_path / "FILE").write_text("x")
    places = {"ONE": one, "OUT": tmp_path / "OUT", "EMPTY": tmp_path / "EMPTY"}
    places["FILE/x"] = tmp_path / "FILE" / "x"
    given = [str(places.get(argument, argument)) for argument in arguments]
    if arguments[0] == "grade" and "--course" not in arguments and len(arguments) > 3:
        given += ["--course", str(course)]
    monkeypatch.setattr(sys, "argv", ["raybook-grader", *given])
    try:
        code: object = main()
    except SystemExit as ended:
        code = ended.code
    assert code == 2
    assert words in capsys.readouterr().err
    assert not done(tmp_path / "OUT")


def test_no_database_of_ours_is_refused(one: Path, course: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    out.mkdir()
    (out / "grades.sqlite").write_text("not a database, but a text that is long enough to be read")
    ended = run("grade", one, "--out", out, "--course", course)
    assert ended.returncode == 2
    assert "grades.sqlite" in ended.stderr
