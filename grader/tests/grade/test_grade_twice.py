"""A class that is graded twice has the same grades, to the byte, however many work at it."""

from __future__ import annotations

import shutil
from pathlib import Path

from make_class import make_class
from small_course import FOLDER, run, small_course, verdicts


def test_the_same_grades_to_the_byte(tmp_path: Path) -> None:
    course = small_course(tmp_path / "course")
    # What the diagnosis would learn first; test_grade_resume.py compares grades that have it.
    shutil.rmtree(course / FOLDER / "mistakes")
    expected = make_class(tmp_path / "class")
    wrong = [name for name in expected if name.startswith("wrong-")]
    for name in list(expected):
        if name == "never-ends" or name.startswith("right-") or name in wrong[3:]:
            shutil.rmtree(tmp_path / "class" / name)
            del expected[name]
    for jobs in ("1", "3"):
        out = tmp_path / jobs
        done = run("grade", tmp_path / "class", "--out", out, "--course", course, "--jobs", jobs)
        assert done.returncode == 0, done.stdout + done.stderr
    assert verdicts(tmp_path / "1") == expected
    first, second = ((tmp_path / jobs / "grades.json").read_bytes() for jobs in ("1", "3"))
    assert first == second
