"""A class whose results are built as values: no grading."""

from __future__ import annotations

from pathlib import Path

from raybook_grader.checks.result import Status, conclude
from raybook_grader.course import Assignment, BuildCheck, Course, Limits, ProbeCheck
from raybook_grader.database import Database
from raybook_grader.grading.result import ModuleResult, from_checks, internal_error, missing

BUILD = BuildCheck("compiles", 4)
HIDDEN = ProbeCheck("edge cases", 6, "probe.c", "oracle.py", "edges", 1, hidden=True)
SECRET = "ray 17: expected t = 2.5, got no hit"
FORMULA = '=HYPERLINK("http://example.org","x")'


def assignment(number: str, module: str, points: float, optional: bool = False) -> Assignment:
    checks = (BUILD, HIDDEN)
    return Assignment(
        Path(), number, module, f"About {module}", points, optional, (), (), Limits(), checks
    )


MODULES = (assignment("01", "triangle", 10), assignment("02", "aabb", 10, optional=True))
COURSE = Course(Path(), "A course", MODULES)


def right() -> ModuleResult:
    return from_checks([conclude(c, Status.PASSED, "as it should be") for c in (BUILD, HIDDEN)])


def wrong(message: str = SECRET) -> ModuleResult:
    return from_checks(
        [conclude(BUILD, Status.PASSED, "no warning"), conclude(HIDDEN, Status.FAILED, message)]
    )


def broken() -> ModuleResult:
    return internal_error("the grader failed here", "a traceback")


def stub() -> ModuleResult:
    return missing("still the stub that the course hands out")


def class_of(folder: Path, results: dict[str, tuple[ModuleResult | None, ...]]) -> Database:
    """The class's database: for each submission its result in 01 and, if given, in 02."""
    folder.mkdir(exist_ok=True)
    database = Database(folder, "A course")
    keys = {
        (name, MODULES[i].number): f"{name} {i}"
        for name, found in results.items()
        for i in range(len(found))
    }
    database.plan(MODULES, {name: None for name in results}, keys)
    for name, found in results.items():
        for i, result in enumerate(found):
            if result is not None:
                database.store(f"{name} {i}", result, final=True)
    return database
