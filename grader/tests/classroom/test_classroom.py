"""The made-up class is what it says: as distinct as it should be, and read as it was written."""

from __future__ import annotations

import random
import subprocess
from pathlib import Path

import pytest
from classroom import CHECKOUT, KIT
from packing import send
from rewording import reword
from students import DISTINCT, Student, make_students, write_students

from raybook_grader.course import load_course
from raybook_grader.grading.key import Keys
from raybook_grader.kit import load_kit
from raybook_grader.submissions import find_submissions

COURSE = load_course(CHECKOUT)
ASSIGNMENTS = [assignment for assignment in COURSE.assignments if assignment.is_graded]
OWNED = [path for assignment in ASSIGNMENTS for path in assignment.owned]
COUNT = 90


@pytest.fixture(scope="module")
def students() -> list[Student]:
    return make_students(COURSE, ASSIGNMENTS, COUNT, seed=3)


def test_all_hand_in_all_modules(students: list[Student]) -> None:
    assert len(students) == COUNT
    assert all(list(s.modules) == [a.number for a in ASSIGNMENTS] for s in students)
    assert len(ASSIGNMENTS) == 11


def test_the_same_seed_makes_the_same_class(students: list[Student]) -> None:
    assert make_students(COURSE, ASSIGNMENTS, COUNT, seed=3) == students
    assert make_students(COURSE, ASSIGNMENTS, COUNT, seed=4) != students


def test_it_is_read_as_it_was_written(students: list[Student], tmp_path: Path) -> None:
    forms = write_students(students, tmp_path / "class", seed=3)
    assert len(forms) >= 7, "every way to send files"
    found, ignored = find_submissions(tmp_path / "class", OWNED)
    assert (len(found), ignored) == (COUNT, [])
    for submission, student in zip(found, students, strict=True):
        assert submission.id == student.name
        assert (submission.problem is not None) == student.broken
        sent = {p: text for v in student.modules.values() for p, text in v.files.items()}
        read = {path: file.content for path, file in submission.files.items()}
        assert read == ({} if student.broken else sent), student.name


def test_a_third_of_the_work_is_different(students: list[Student], tmp_path: Path) -> None:
    write_students(students, tmp_path / "class", seed=3)
    keys = Keys(COURSE, load_kit(KIT))
    found, _ = find_submissions(tmp_path / "class", OWNED)
    jobs = {
        keys.key(a, {p: f for p, f in submission.files.items() if p in a.owned})
        for submission in found
        for a in ASSIGNMENTS
    }
    assert len(jobs) / (COUNT * len(ASSIGNMENTS)) == pytest.approx(DISTINCT, abs=0.02)


def test_what_is_reworded_is_different_and_compiles(students: list[Student]) -> None:
    seen = set()
    for student in students:
        version = student.modules["02"]
        if version.exhibit is None or version.files == version.exhibit.files:
            continue
        [(path, text)] = version.files.items()
        seen.add(text)
        assert text != version.exhibit.files[path]
        compile_quietly(text, path)
    assert len(seen) > 5


def compile_quietly(text: bytes, path: str) -> None:
    """No warning: a reworded module must not lose the point for that."""
    command = ["gcc", "-std=c99", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", "-fopenmp"]
    beside = str(CHECKOUT / Path(path).parent)
    ended = subprocess.run(
        [*command, "-I", str(CHECKOUT / "src"), "-iquote", beside, "-x", "c", "-"],
        input=text,
        capture_output=True,
        check=False,
    )
    assert ended.returncode == 0, ended.stderr.decode()


def test_own_functions_get_other_names_everywhere() -> None:
    text = (
        b"static int half(int x)\n{\n    return x / 2;\n}\nint f(int x) { return half(x) + 1; }\n"
    )
    renamed = [reword(text, n, random.Random(n)) for n in range(20)]
    assert len(set(renamed)) == 20
    some = next(t for t in renamed if b"int half(" not in t)
    assert b" half(" not in some
    assert some.count(b"half_") == 2


def test_each_form_can_be_sent(tmp_path: Path) -> None:
    rng = random.Random(0)
    files = {"src/shapes/triangle.c": b"int x;\n"}
    forms = {send(tmp_path, f"s{n}", files, rng) for n in range(60)}
    assert len(forms) == 7
