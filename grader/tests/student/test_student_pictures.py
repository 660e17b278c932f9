"""Each public picture depends on what its assignment says, and on nothing else.

A student's program has all modules in it, done or not. So each picture is rendered with every other
assignment as a stub, but for those that it needs and, in turn, those that it varies with: it must
be what `make check` expects then. With its own assignment as a stub it must not.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator

import pytest
from student_edition import ROOT

from raybook_grader.course.pictures import PublicPicture
from raybook_grader.expected.live import Live
from raybook_grader.expected.programs import reference_program
from raybook_grader.literate.check import load_assignments
from raybook_grader.student.pictures import JudgedPicture, judge_picture
from raybook_grader.student.project import Assignment, read_assignments

ASSIGNMENTS = {a.number: a for a in read_assignments(ROOT)}
EXERCISES = {a.number: a.todos for a in load_assignments(ROOT)[0]}
PICTURES = {f"{a.number}-{p.name}": (a, p) for a in ASSIGNMENTS.values() for p in a.pictures}
SECONDS = 60.0


def judged(assignment: Assignment, picture: PublicPicture, undone: set[str]) -> JudgedPicture:
    """The picture of a student who has left ``undone`` undone."""
    varied = tuple(n for n in picture.varies_with if n in undone)
    expected = Live(ROOT).statistics(assignment, picture, varied)
    assert expected is not None
    program = reference_program(ROOT, frozenset(t for n in undone for t in EXERCISES[n]))
    return judge_picture(program, ROOT, picture, expected, SECONDS)


def known(numbers: tuple[str, ...]) -> list[str]:
    return [n for n in numbers if n in ASSIGNMENTS]


def ways(picture: PublicPicture) -> Iterator[set[str]]:
    """Every set of the assignments that it varies with, as what is not done."""
    varied = known(picture.varies_with)
    for count in range(len(varied) + 1):
        yield from map(set, itertools.combinations(varied, count))


@pytest.mark.parametrize("name", PICTURES)
def test_what_the_picture_needs_is_enough(name: str) -> None:
    assignment, picture = PICTURES[name]
    assert all("01" <= number <= "10" for number in (*picture.needs, *picture.varies_with))
    apart = {assignment.number, *picture.needs, *picture.varies_with}
    for varied in ways(picture):
        found = judged(assignment, picture, (ASSIGNMENTS.keys() - apart) | varied)
        assert found.is_right, (sorted(varied), found.reasons)


@pytest.mark.parametrize("name", PICTURES)
def test_the_picture_shows_its_assignment(name: str) -> None:
    assignment, picture = PICTURES[name]
    if not EXERCISES[assignment.number]:
        pytest.skip("has no stub")
    found = judged(assignment, picture, {assignment.number})
    assert not found.is_right or assignment.number in SLOW_NOT_WRONG


SLOW_NOT_WRONG = {"02", "03"}
"""Their stubs give the right picture, later."""
