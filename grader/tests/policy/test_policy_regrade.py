"""Published grades change only when somebody has seen how, and agreed."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest
from policy_fixtures import Command
from policy_fixtures import course as course
from policy_fixtures import grade as grade
from policy_fixtures import grader as grader
from rich.console import Console
from tiny_course import grades, hand_in, modules, write_rubric

from raybook_grader.checks.artefact import check_artefact
from raybook_grader.checks.result import Status, conclude
from raybook_grader.grading import module as grading

CHANGED = {"a": 1, "b": 9}
"""Other points of the two pictures: as good as another version of the grader."""


@pytest.fixture
def graded(tmp_path: Path, grade: Command) -> Command:
    """A class that has been graded: s1 and s2 with the same work, s3 with other work."""
    for name, right in (("s1", "a"), ("s2", "a"), ("s3", "ab")):
        hand_in(tmp_path / "class", name, {"01": right, "02": name})
    done = grade()
    assert done.code == 0 and "chang" not in done.out, done.out + done.err
    return grade


def state(out: Path) -> dict[str, bytes]:
    """All that is published."""
    return {
        str(file.relative_to(out)): file.read_bytes()
        for file in [out / "grades.json", *out.rglob("*.html")]
    }


def break_picture_a(monkeypatch: pytest.MonkeyPatch, status: Status = Status.FAILED) -> None:
    """From now on the grader finds something else in picture a of assignment 01."""

    def other(check, content, workshop):  # type: ignore[no-untyped-def]
        if check.file == "01a.exr":
            return conclude(check, status, "otherwise")
        return check_artefact(check, content, workshop)

    monkeypatch.setattr(grading, "check_artefact", other)


def test_another_rubric_is_shown_before_it_counts(
    tmp_path: Path, course: Path, graded: Command
) -> None:
    before = state(tmp_path / "out")
    write_rubric(course, "01", CHANGED)
    held = graded()
    assert held.code == 0
    assert "would change: s1 01 pictures01: fail 4 -> fail 1" in held.out
    assert "    picture a: passed 4 -> passed 1" in held.out
    assert "s3 01" in held.out and "s3 01 pictures01: pass 10 -> pass 10" in held.out
    assert " 02 " not in held.out.split("would change", 1)[1]
    assert "3 published grades of 3 students would change though" in held.out
    assert "--apply applies it" in held.out and "grades:" not in held.out
    assert state(tmp_path / "out") == before

    applied = graded("--apply")
    assert applied.code == 0 and "0 modules to grade" in applied.out
    assert "changed: s1 01 pictures01: fail 4 -> fail 1" in applied.out
    assert modules(tmp_path / "out", "s1")["01"]["score"] == 1
    assert "chang" not in graded().out


def test_new_work_needs_nobody_s_agreement(tmp_path: Path, graded: Command) -> None:
    hand_in(tmp_path / "class", "s1", {"01": "ab"})
    hand_in(tmp_path / "class", "s4", {"01": "b"})
    done = graded()
    assert done.code == 0
    assert "changed: s1 01 pictures01: fail 4 -> pass 10" in done.out
    assert {n: s["score"] for n, s in grades(tmp_path / "out").items()} == {
        "s1": 10, "s2": 4, "s3": 10, "s4": 6,
    }  # fmt: skip


def test_new_work_waits_with_the_rest(tmp_path: Path, course: Path, graded: Command) -> None:
    hand_in(tmp_path / "class", "s4", {"01": "b"})
    write_rubric(course, "01", CHANGED)
    assert "nothing is applied" in graded().out
    assert set(grades(tmp_path / "out")) == {"s1", "s2", "s3"}
    assert graded("--apply").code == 0
    assert grades(tmp_path / "out")["s4"]["score"] == 9


def test_regrade_says_what_would_change_and_for_whom(
    tmp_path: Path, graded: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    before = state(tmp_path / "out")
    break_picture_a(monkeypatch)
    assert "0 modules to grade" in graded().out, "nobody has asked for it"
    held = graded("--regrade", "s1")
    assert held.code == 0
    assert "would change: s1 01 pictures01: fail 4 -> fail 0" in held.out
    assert "would change: s2 01" in held.out, "it is the same work"
    assert "s3 01" not in held.out.split("would change", 1)[1]
    assert state(tmp_path / "out") == before
    assert "0 modules to grade" in graded().out
    assert state(tmp_path / "out") == before

    monkeypatch.setattr(grading, "check_artefact", check_artefact)
    applied = graded("--regrade", "s1", "--apply")
    assert "0 modules to grade" in applied.out, "what was computed is kept"
    assert {n: s["score"] for n, s in grades(tmp_path / "out").items()} == {
        "s1": 0, "s2": 0, "s3": 10,
    }  # fmt: skip


def test_regrade_is_done_anew_once_it_was_seen(
    graded: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    with monkeypatch.context() as patch:
        break_picture_a(patch)
        assert "fail 4 -> fail 0" in graded("--regrade", "s1").out
    again = graded("--regrade", "s1")
    assert "the grades stay as they are" in again.out and "would change" not in again.out


def test_regrade_all(graded: Command, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    break_picture_a(monkeypatch)
    assert "3 published grades of 3 students would change" in graded("--regrade", "all").out
    assert graded("--regrade", "all", "--apply").code == 0
    assert grades(tmp_path / "out")["s3"]["score"] == 6
    assert graded("--regrade", "s9").code == 2


def test_an_internal_error_takes_no_points_away(
    tmp_path: Path, graded: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    before = state(tmp_path / "out")
    with monkeypatch.context() as patch:
        break_picture_a(patch, Status.INTERNAL_ERROR)
        for arguments in ((), ("--apply",)):
            held = graded("--regrade", "s3", *arguments)
            assert held.code == 3
            assert "pass 10 -> internal-error ?" in held.out
            assert "nothing is applied: 1 modules that have points" in held.out
            assert state(tmp_path / "out") == before
    done = graded("--regrade", "s3", "--apply")
    assert done.code == 0 and "1 modules to grade" in done.out


def test_a_submission_that_is_gone_is_asked_about(tmp_path: Path, graded: Command) -> None:
    (tmp_path / "class" / "s2").rename(tmp_path / "away")
    held = graded()
    assert "would change: s2 01 pictures01: fail 4 -> no submission" in held.out
    assert set(grades(tmp_path / "out")) == {"s1", "s2", "s3"}
    assert graded("--apply").code == 0
    assert set(grades(tmp_path / "out")) == {"s1", "s3"}


def test_other_rules_are_asked_about(tmp_path: Path, graded: Command) -> None:
    (tmp_path / "class" / "s3").rename(tmp_path / "class" / "s3--20261002T120000Z")
    assert "chang" not in graded().out
    rules = tmp_path / "class" / "course.toml"
    rules.write_text("[late]\npercent_per_day = 10\n[deadlines]\n01 = 2026-10-01T12:00:00Z\n")
    held = graded()
    assert "would change: s3 01 pictures01: pass 10 -> pass 9" in held.out
    assert "    not late -> 1 day late: -10 %" in held.out
    assert grades(tmp_path / "out")["s3"]["score"] == 10
    assert graded("--apply").code == 0
    assert grades(tmp_path / "out")["s3"]["score"] == 9


def test_fresh_forgets_and_says_what_has_changed(
    tmp_path: Path, course: Path, graded: Command
) -> None:
    write_rubric(course, "01", CHANGED)
    done = graded("--fresh")
    assert "changed: s1 01 pictures01: fail 4 -> fail 1" in done.out
    assert grades(tmp_path / "out")["s1"]["score"] == 1


@pytest.mark.parametrize(("answer", "score"), [("y", 1), ("Yes ", 1), ("", 4), ("no", 4)])
def test_at_a_terminal_it_asks(
    tmp_path: Path,
    course: Path,
    graded: Command,
    monkeypatch: pytest.MonkeyPatch,
    answer: str,
    score: int,
) -> None:
    write_rubric(course, "01", CHANGED)
    monkeypatch.setattr(Console, "is_terminal", True)
    monkeypatch.setattr(Console, "input", lambda console, words: answer)
    monkeypatch.setattr(sys.stdin, "isatty", lambda: True)
    assert graded().code == 0
    assert grades(tmp_path / "out")["s1"]["score"] == score
