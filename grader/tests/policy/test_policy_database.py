"""What the database keeps: drafts beside what is published, decisions for ever, old versions."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from contextlib import closing
from datetime import UTC, datetime
from pathlib import Path

import pytest

from raybook_grader.checks.result import Status, conclude
from raybook_grader.course import Assignment, BuildCheck, Limits
from raybook_grader.database import NAME, Database, Version, database
from raybook_grader.errors import BadInput
from raybook_grader.grading.result import ModuleResult, from_checks

ASSIGNMENT = Assignment(Path(), "01", "m", "t", 10, False, (), (), Limits(), ())
FIRST = datetime(2026, 10, 1, tzinfo=UTC)

VERSION_1 = """
CREATE TABLE about (version INTEGER NOT NULL, course TEXT NOT NULL);
CREATE TABLE assignment (number TEXT PRIMARY KEY, module TEXT NOT NULL, title TEXT NOT NULL,
    points REAL NOT NULL, optional INTEGER NOT NULL);
CREATE TABLE submission (id TEXT PRIMARY KEY, problem TEXT);
CREATE TABLE work (key TEXT PRIMARY KEY, final INTEGER NOT NULL, result TEXT NOT NULL,
    finished TEXT NOT NULL);
CREATE TABLE picture (key TEXT NOT NULL REFERENCES work (key) ON DELETE CASCADE,
    place INTEGER NOT NULL, html BLOB NOT NULL, PRIMARY KEY (key, place));
CREATE TABLE grade (
    submission TEXT NOT NULL REFERENCES submission (id) ON DELETE CASCADE,
    assignment TEXT NOT NULL REFERENCES assignment (number) ON DELETE CASCADE,
    key TEXT NOT NULL, PRIMARY KEY (submission, assignment));
INSERT INTO about VALUES (1, 'Old');
INSERT INTO assignment VALUES ('01', 'm', 't', 10, 0);
INSERT INTO submission VALUES ('s1', NULL), ('s2', 'broken');
INSERT INTO work VALUES ('k', 1, '{"verdict": "pass", "score": 10.0, "message": "", "checks": [],
    "traceback": "", "diagnosis": []}', '2026-01-01 00:00:00');
INSERT INTO grade VALUES ('s1', '01', 'k'), ('s2', '01', 'k');
"""


def worth(points: float, picture: str = "") -> ModuleResult:
    check = conclude(BuildCheck("c", 10), Status.PASSED, "", share=points / 10, picture=picture)
    return from_checks([check])


@pytest.fixture
def graded(tmp_path: Path) -> Iterator[Database]:
    """Two students with the same work, published."""
    with closing(Database(tmp_path, "A course")) as opened:
        opened.plan([ASSIGNMENT], {"s1": None, "s2": None}, {("s1", "01"): "k", ("s2", "01"): "k"})
        opened.store("k", worth(5, "old picture"), final=True)
        opened.publish()
        yield opened


def points(opened: Database) -> dict[str, float | None]:
    return {
        student.id: result.score if (result := student.results["01"]) else None
        for student in opened.students()
    }


def test_a_draft_is_met_and_leaves_no_trace(graded: Database, tmp_path: Path) -> None:
    graded.begin_draft()
    graded.plan([ASSIGNMENT], {"s1": None, "s3": None}, {("s1", "01"): "new", ("s3", "01"): "k"})
    assert points(graded) == {"s1": None, "s3": 5}
    assert graded.waiting() == {"s1": {"new"}}
    graded.store("new", worth(7), final=True)
    with closing(Database(tmp_path)) as other:
        assert points(other) == {"s1": 5, "s2": 5}, "what another command reads meanwhile"
    graded.drop_draft()
    assert points(graded) == {"s1": 5, "s2": 5}
    assert "new" in graded.done(), "the work is kept"


def test_a_draft_takes_the_place_of_what_was_published(graded: Database) -> None:
    graded.begin_draft()
    versions = [Version("k", "f", FIRST), Version("new", "g", None)]
    graded.plan([ASSIGNMENT], {"s1": None}, {("s1", "01"): versions}, "New name", 'counts = "best"')
    graded.store("new", worth(7), final=True)
    graded.publish()
    assert points(graded) == {"s1": 7}
    assert graded.versions("s1") == {"01": versions}
    assert graded.course() == "New name" and graded.policy().counts == "best"


def test_work_done_again_takes_the_old_one_s_place(graded: Database) -> None:
    again = graded.redo({"k"}, keep_shown=False)
    graded.begin_draft()
    graded.plan([ASSIGNMENT], {"s1": None}, {("s1", "01"): again["k"]})
    graded.store(again["k"], worth(8, "new picture"), final=True)
    graded.publish()
    assert graded.done() == {"k"} and graded.versions("s1") == {"01": [Version("k")]}
    result = graded.student("s1", pictures=True).results["01"]
    assert result and result.score == 8 and result.checks[0].picture == "new picture"


@pytest.mark.parametrize(
    ("shown", "keep", "kept"), [(0, 0, True), (0, 1, True), (1, 1, True), (1, 0, False)]
)
def test_what_was_begun_again_goes_on_until_it_was_seen(
    graded: Database, shown: bool, keep: bool, kept: bool
) -> None:
    again = graded.redo({"k"}, keep_shown=False)
    graded.store(again["k"], worth(8), final=True)
    graded.drop_draft(shown=again if shown else ())
    graded.redo({"k"}, keep_shown=keep)
    assert (again["k"] in graded.done()) == kept
    assert "k" in graded.done()


def test_decisions_are_kept_for_ever(graded: Database, tmp_path: Path) -> None:
    assert graded.decide("s1", "01", 9, "first", "prof").number == 1
    graded.decide("s1", "01", 8, "second", "prof")
    assert points(graded) == {"s1": 8, "s2": 5}
    graded.withdraw(2, "no", "prof")
    assert points(graded)["s1"] == 9, "the one before holds again"
    graded.forget()
    graded.plan([ASSIGNMENT], {"s2": None}, {("s2", "01"): "k"})
    assert points(graded) == {"s2": None}
    assert [(d.number, d.points, d.withdraws, d.holds) for d in graded.decisions()] == [
        (1, 9, None, True),
        (2, 8, None, False),
        (3, None, 2, False),
    ]
    graded.plan([ASSIGNMENT], {"s1": None}, {("s1", "01"): "k"})
    graded.store("k", worth(5), final=True)
    assert points(graded) == {"s1": 9}
    with closing(sqlite3.connect(tmp_path / NAME)) as raw:
        for change in ("DELETE FROM decision", "UPDATE decision SET points = 0"):
            with pytest.raises(sqlite3.IntegrityError, match="decision is"):
                raw.execute(change)


def test_clocks_that_jump_change_no_order(
    graded: Database, monkeypatch: pytest.MonkeyPatch
) -> None:
    times = iter(["2030-01-01", "2020-01-01", "2025-01-01", "1970-01-01"])
    monkeypatch.setattr(database, "_now", lambda: next(times))
    graded.decide("s1", "01", 9, "first", "prof")
    graded.decide("s1", "01", 8, "second", "prof")
    graded.store("k", worth(4), final=True)
    graded.store("k", worth(3), final=True)
    assert points(graded) == {"s1": 8, "s2": 3}
    assert [d.at for d in graded.decisions()] == ["2030-01-01", "2020-01-01"]


def test_version_1_moves_up(tmp_path: Path) -> None:
    with closing(sqlite3.connect(tmp_path / NAME)) as old:
        old.executescript(VERSION_1)
    for _ in range(2):
        with closing(Database(tmp_path)) as opened:
            assert points(opened) == {"s1": 10, "s2": 10}
            assert opened.course() == "Old" and opened.published()
            assert opened.student("s2").problem == "broken"
            assert opened.done() == {"k"}
    with closing(sqlite3.connect(tmp_path / NAME)) as new:
        tables = "SELECT sql FROM sqlite_master WHERE sql IS NOT NULL ORDER BY name"
        fresh = tmp_path / "fresh"
        fresh.mkdir()
        Database(fresh, "Other").close()
        with closing(sqlite3.connect(fresh / NAME)) as made:
            assert new.execute(tables).fetchall() == made.execute(tables).fetchall()


@pytest.mark.parametrize(
    ("statement", "words"),
    [
        ("UPDATE about SET version = 9", "version 9, expected 2"),
        ("DROP TABLE about", "another program's database"),
    ],
)
def test_other_databases_are_refused(
    graded: Database, tmp_path: Path, statement: str, words: str
) -> None:
    with closing(sqlite3.connect(tmp_path / NAME)) as raw:
        raw.execute(statement)
        raw.commit()
    with pytest.raises(BadInput, match=words):
        Database(tmp_path)
