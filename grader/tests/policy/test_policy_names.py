"""Who handed something in, and when, from the names of submissions."""

from __future__ import annotations

from datetime import UTC, datetime
from pathlib import Path
from zoneinfo import ZoneInfo

import pytest

from raybook_grader.course import Assignment, Limits
from raybook_grader.errors import BadInput
from raybook_grader.grading.plan import versions_of
from raybook_grader.policy import Counts
from raybook_grader.submissions import Submission, SubmittedFile, find_submissions, latest

ZURICH = ZoneInfo("Europe/Zurich")
TEN = datetime(2026, 11, 20, 22, 10, tzinfo=UTC)


def found(folder: Path, *names: str) -> list[tuple[str, datetime | None]]:
    for name in names:
        (folder / name).mkdir()
    return [(s.id, s.time) for s in find_submissions(folder, ["a.c"], ZURICH)[0]]


@pytest.mark.parametrize(
    ("name", "student", "time"),
    [
        ("s042", "s042", None),
        ("s042--2026-11-20T23:10:00+01:00", "s042", TEN),
        ("s042--2026-11-20T23:10:00", "s042", TEN),
        ("s042--2026-11-20T23:10", "s042", TEN),
        ("s042--20261120T221000Z", "s042", TEN),
        ("a--b--20261120T231000+0100", "a--b", TEN),
        ("s042--final", "s042--final", None),
        ("s042-2026-11-20T23:10:00", "s042-2026-11-20T23:10:00", None),
        ("--2026-11-20T23:10:00", "--2026-11-20T23:10:00", None),
    ],
)
def test_names(tmp_path: Path, name: str, student: str, time: datetime | None) -> None:
    assert found(tmp_path, name) == [(student, time)]


def test_archives_have_times_too(tmp_path: Path) -> None:
    for i, suffix in enumerate((".zip", ".tar.gz", ".tgz")):
        (tmp_path / f"s{i}--2026-11-20T23:10:00{suffix}").touch()
    assert [s.time for s in find_submissions(tmp_path, [], ZURICH)[0]] == [TEN] * 3


@pytest.mark.parametrize(
    ("name", "fault"),
    [
        ("s042--2026-13-20T23:10:00", "expected a time such as"),
        ("s042--2026-11-20", "a date without a time of day"),
        ("s042--20261120", "a date without a time of day"),
        ("s042--2026-11-20T23:10:00 (1)", "expected a time such as"),
        ("s042--2026-10-25T02:30:00", "twice"),
    ],
)
def test_a_slip_in_a_time_is_no_other_student(tmp_path: Path, name: str, fault: str) -> None:
    with pytest.raises(BadInput, match=fault):
        found(tmp_path, name)


@pytest.mark.parametrize(
    "names",
    [
        ("s1", "s1--2026-11-20T23:10:00"),
        ("s1--2026-11-20T23:10:00", "s1--2026-11-20T22:10:00+00:00"),
    ],
)
def test_an_order_that_nobody_knows_is_refused(tmp_path: Path, names: tuple[str, ...]) -> None:
    with pytest.raises(BadInput, match="'s1'"):
        found(tmp_path, *names)


def test_they_come_in_the_order_of_their_times(tmp_path: Path) -> None:
    names = ("b", "a--20261120T221000Z", "a--2026-11-20T23:09:00+01:00")
    assert [name for name, _ in found(tmp_path, *names)] == ["a", "a", "b"]
    times = [s.time for s in find_submissions(tmp_path, [], ZURICH)[0][:2]]
    assert times == [datetime(2026, 11, 20, 22, 9, tzinfo=UTC), TEN]
    last = latest(find_submissions(tmp_path, [], ZURICH)[0])
    assert [(s.id, s.time) for s in last] == [("a", TEN), ("b", None)]


def test_the_class_s_rules_are_no_stray_file(tmp_path: Path) -> None:
    (tmp_path / "course.toml").touch()
    (tmp_path / "notes.txt").touch()
    (tmp_path / "s1").mkdir()
    assert find_submissions(tmp_path, [])[1] == ["notes.txt"]


ASSIGNMENT = Assignment(Path(), "01", "m", "t", 1, False, ("a.c", "b.c"), (), Limits(), ())


def submission(**files: bytes) -> Submission:
    return Submission("s1", {f"{n}.c": SubmittedFile(c) for n, c in files.items()})


@pytest.mark.parametrize(
    ("submissions", "places"),
    [
        ([submission(a=b"1")], [0]),
        ([submission(a=b"1"), submission(a=b"1"), submission(a=b"1", x=b"2")], [0]),
        ([submission(a=b"1"), submission(x=b"2")], [0]),
        ([submission(a=b"1"), submission(a=b"2"), submission(a=b"1")], [0, 1, 2]),
        ([submission(a=b"1"), submission(a=b"1", b=b"2"), submission(b=b"2")], [0, 1, 2]),
        ([submission(x=b"1"), submission(a=b"1")], [1]),
        ([submission(x=b"1"), submission()], [1]),
    ],
)
def test_a_module_is_handed_in_when_its_files_change(
    submissions: list[Submission], places: list[int]
) -> None:
    for counts, expected in ((Counts.BEST, places), (Counts.LAST, places[-1:])):
        versions = versions_of(ASSIGNMENT, submissions, counts)
        assert [next(i for i, s in enumerate(submissions) if s is v) for v, _ in versions] == (
            expected
        )
