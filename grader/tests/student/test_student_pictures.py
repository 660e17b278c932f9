"""Each public picture depends on what its assignment says, and on nothing else.

A student's program has all modules in it, done or not. So each picture is rendered with every other
assignment as a stub, but for those that it needs and, in turn, those that it varies with: it must
be what `make check` expects then. With its own assignment as a stub it must not.
"""

from __future__ import annotations

import functools
import itertools
import os
import shlex
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest
from student_edition import ROOT

from raybook_grader.course.pictures import PublicPicture
from raybook_grader.expected.live import Live
from raybook_grader.literate.check import load_assignments
from raybook_grader.literate.tree import load_tree
from raybook_grader.student.pictures import JudgedPicture, judge_picture
from raybook_grader.student.project import Assignment, read_assignments

ASSIGNMENTS = {a.number: a for a in read_assignments(ROOT)}
EXERCISES = {a.number: a.todos for a in load_assignments(ROOT)[0]}
PICTURES = {f"{a.number}-{p.name}": (a, p) for a in ASSIGNMENTS.values() for p in a.pictures}
SECONDS = 60.0


def asked(*words: str) -> str:
    """What make answers about the build that `make check` uses."""
    names = ("PATH", "HOME", "UNITY_ROOT")
    environment = {name: os.environ[name] for name in names if name in os.environ}
    command = ["make", "-C", str(ROOT), "-s", "--no-print-directory", "CHECK=yes", *words]
    done = subprocess.run(command, env=environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout.splitlines()[-1]


@functools.cache
def linked() -> list[str]:
    """The objects of the reference, `main.o` included."""
    asked("build/meshes/done", "programs")
    objects = asked("list-objects").split()
    return [*objects, str(Path(objects[0]).parents[1] / "main.o")]


@functools.cache
def stub_object(file: str, folder: str) -> str:
    """A file of the source with all its exercises as stubs."""
    todos = [name for name, todo in load_tree(ROOT).todos.items() if todo.file == file]
    target = str(Path(folder, file.replace("/", "-")).with_suffix(".o"))
    command = [*shlex.split(asked("list-compiler")), *(f"-DTODO_{name}" for name in todos)]
    subprocess.run([*command, "-c", file, "-o", target], cwd=ROOT, check=True)
    return target


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> str:
    return str(tmp_path_factory.mktemp("stubs"))


def program(undone: set[str], folder: str) -> Path:
    """The renderer with these assignments as stubs, the quick way: only stubs are compiled."""
    files = {path for number in undone for path in ASSIGNMENTS[number].sources if EXERCISES[number]}
    suffixes = {path.removeprefix("src").replace(".c", ".o"): path for path in files}
    objects: list[str] = []
    for reference in linked():
        own = next((p for s, p in suffixes.items() if reference.endswith(s)), None)
        objects.append(stub_object(own, folder) if own else reference)
    target = Path(folder, "raybook")
    libraries = shlex.split(asked("list-libraries"))
    command = ["gcc", "-fopenmp", *objects, *libraries, "-o", str(target)]
    subprocess.run(command, cwd=ROOT, check=True)
    return target


def judged(
    assignment: Assignment, picture: PublicPicture, undone: set[str], folder: str
) -> JudgedPicture:
    """The picture of a student who has left ``undone`` undone."""
    varied = tuple(n for n in picture.varies_with if n in undone)
    expected = Live(ROOT).statistics(assignment, picture, varied)
    assert expected is not None
    return judge_picture(program(undone, folder), ROOT, picture, expected, SECONDS)


def known(numbers: tuple[str, ...]) -> list[str]:
    return [n for n in numbers if n in ASSIGNMENTS]


def ways(picture: PublicPicture) -> Iterator[set[str]]:
    """Every set of the assignments that it varies with, as what is not done."""
    varied = known(picture.varies_with)
    for count in range(len(varied) + 1):
        yield from map(set, itertools.combinations(varied, count))


@pytest.mark.parametrize("name", PICTURES)
def test_what_the_picture_needs_is_enough(name: str, folder: str) -> None:
    assignment, picture = PICTURES[name]
    assert set(picture.needs) <= ASSIGNMENTS.keys()
    apart = {assignment.number, *picture.needs, *picture.varies_with}
    for varied in ways(picture):
        found = judged(assignment, picture, (ASSIGNMENTS.keys() - apart) | varied, folder)
        assert found.is_right, (sorted(varied), found.reasons)


@pytest.mark.parametrize("name", PICTURES)
def test_the_picture_shows_its_assignment(name: str, folder: str) -> None:
    assignment, picture = PICTURES[name]
    if not EXERCISES[assignment.number]:
        pytest.skip("has no stub")
    found = judged(assignment, picture, {assignment.number}, folder)
    assert not found.is_right or assignment.number in SLOW_NOT_WRONG


SLOW_NOT_WRONG = {"02", "03"}
"""Their stubs give the right picture, later."""
