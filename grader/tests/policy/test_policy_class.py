"""A class with rules, graded by the real command: times in names, penalties in grades.json."""

from __future__ import annotations

from pathlib import Path

from policy_fixtures import Command
from policy_fixtures import course as course
from policy_fixtures import grade as grade
from policy_fixtures import grader as grader
from tiny_course import grades, hand_in, modules

RULES = """
course = "Pictures, 2026"
time_zone = "Europe/Zurich"
counts = "{counts}"
[late]
days = 1
percent_per_day = 10
[deadlines]
01 = 2026-10-01T12:00:00
02 = 2026-11-01T12:00:00
03 = 2026-12-01T12:00:00
[[extension]]
student = "extended"
days = 7
[[extension]]
student = "typo"
days = 7
"""


def write_class(tmp_path: Path, counts: str = "last") -> Path:
    folder = tmp_path / "class"
    hand_in(folder, "plain", {"01": "ab"})
    hand_in(folder, "late--2026-10-04T12:00:00", {"01": "ab", "02": "a"})
    hand_in(folder, "extended--2026-10-04T12:00:00", {"01": "ab"})
    hand_in(folder, "twice--2026-09-30T12:00:00", {"01": "b"})
    hand_in(folder, "twice--2026-10-05T12:00:00", {"01": "a", "02": "ab"})
    hand_in(folder, "twice--2026-12-02T12:00:00", {"01": "a", "02": "ab", "03": "ab"})
    (folder / "course.toml").write_text(RULES.format(counts=counts))
    return folder


def test_the_last_hand_in_counts(tmp_path: Path, grade: Command) -> None:
    write_class(tmp_path)
    done = grade()
    assert done.code == 0, done.out + done.err
    assert "course.toml: deadlines: 3; the last hand-in counts" in done.out
    assert "an extension is for 'typo', who has handed in nothing" in done.out
    assert "submissions without a time in their names, which count as on time: 1" in done.out
    found = grades(tmp_path / "out")
    scores = {name: (s["score"], s["optional"]) for name, s in found.items()}
    assert scores == {
        "extended": (10, 0),
        # Three days late, one of them free; 02 is on time.
        "late": (12, 0),
        "plain": (10, 0),
        # 4 of 10 points four days late, one of them free; 02 on time; 03 is a day late.
        "twice": (12.8, 9),
    }
    assert {name: s["late_days"]["used"] for name, s in found.items()} == {
        "extended": 0, "late": 1, "plain": 0, "twice": 1,
    }  # fmt: skip
    module = modules(tmp_path / "out", "late")["01"]
    assert (module["score"], module["raw_score"], module["verdict"]) == (8, 10, "pass")
    assert module["handed_in"] == "2026-10-04T12:00:00+02:00"
    assert module["penalty"] == {
        "deadline": "2026-10-01T12:00:00+02:00",
        "days_late": 3, "late_days_used": 1, "percent": 20, "points": 2,
    }  # fmt: skip
    assert module["override"] is None
    page = (tmp_path / "out" / "students" / "late.html").read_text()
    assert "3 days late, 1 of them covered by late days. 20 % are taken off: 2 points." in page
    assert "Pictures, 2026" in page
    assert "3 d late" in (tmp_path / "out" / "index.html").read_text()


def test_the_best_hand_in_counts(tmp_path: Path, grade: Command) -> None:
    write_class(tmp_path, "best")
    assert grade().code == 0
    module = modules(tmp_path / "out", "twice")["01"]
    assert (module["score"], module["handed_in"]) == (6, "2026-09-30T12:00:00+02:00")
    assert grades(tmp_path / "out")["twice"]["score"] == 16
    assert modules(tmp_path / "out", "twice")["03"]["score"] == 10, "its late day is still there"


def test_a_class_without_rules_is_as_before(tmp_path: Path, grade: Command) -> None:
    folder = write_class(tmp_path)
    (folder / "course.toml").unlink()
    done = grade()
    assert done.code == 0 and "deadline" not in done.out
    found = grades(tmp_path / "out")
    assert found["late"]["score"] == 14 and found["twice"]["score"] == 14
    module = modules(tmp_path / "out", "late")["01"]
    assert module["score"] == module["raw_score"] and module["penalty"] is None


def test_a_fault_in_the_rules_stops_before_anything_is_done(tmp_path: Path, grade: Command) -> None:
    folder = write_class(tmp_path)
    (folder / "course.toml").write_text("dead_lines = 3\n")
    done = grade()
    assert done.code == 2 and not (tmp_path / "out").exists()
    assert "course.toml: dead_lines: is no key of this table, expected 'deadlines'" in done.err
    other = tmp_path / "other.toml"
    other.write_text('counts = "best"\n')
    assert grade("--policy", other).code == 0
    assert modules(tmp_path / "out", "twice")["01"]["score"] == 6
