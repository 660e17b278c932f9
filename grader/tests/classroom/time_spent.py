"""Where the time of grading goes: processor time by the kind of check and by what ran in the box.

    build/venv/bin/python grader/tests/classroom/time_spent.py --assignment 03,09

Judges some exhibits of each assignment, half of them right, in this process. The first one of an
assignment is not counted: it makes the cases and compiles the drivers, which a worker does once.
"""

from __future__ import annotations

import argparse
import random
import resource
from collections import defaultdict
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from classroom import CHECKOUT, KIT

from raybook_grader.checks.program import Workshop
from raybook_grader.checks.reference import References
from raybook_grader.checks.result import CheckResult
from raybook_grader.checks.subject import Subject
from raybook_grader.course import Assignment, Check, load_course
from raybook_grader.grading.module import ModuleGrader
from raybook_grader.kit import load_kit
from raybook_grader.museum import Exhibit, exhibits_of
from raybook_grader.museum.visit import with_museum
from raybook_grader.sandbox import Box, BoxResult
from raybook_grader.submissions import SubmittedFile


class Ledger:
    """Seconds by name; nested times count in both."""

    def __init__(self) -> None:
        self.seconds: dict[str, float] = defaultdict(float)

    @contextmanager
    def time(self, name: str) -> Iterator[None]:
        before = used()
        try:
            yield
        finally:
            self.seconds[name] += used() - before

    def told(self, count: int) -> str:
        most_first = sorted(self.seconds.items(), key=lambda item: -item[1])
        return ", ".join(f"{name} {seconds / count:.2f}" for name, seconds in most_first)


def used() -> float:
    """Processor seconds of this process and all that it has waited for."""
    both = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return sum(one.ru_utime + one.ru_stime for one in both)


class TimedBox(Box):
    """Says what compiling, linking and running take."""

    def __init__(self, ledger: Ledger, kit: Path) -> None:
        super().__init__([kit / "include", kit / "objects"])
        self._ledger = ledger

    def run(self, command: Any, **request: Any) -> BoxResult:
        with self._ledger.time(kind_of(command)):
            return super().run(command, **request)


def kind_of(command: list[str]) -> str:
    tool = Path(command[0]).name
    if tool == "objcopy" or tool == "program":
        return {"objcopy": "hiding symbols", "program": "running"}[tool]
    sanitized = " sanitized" if any("-fsanitize" in word for word in command) else ""
    return ("compiling" if "-c" in command else "linking") + sanitized


class TimedGrader(ModuleGrader):
    """Says what each kind of check takes."""

    ledger: Ledger

    def _run(self, check: Check, subject: Subject) -> CheckResult:
        with self.ledger.time(type(check).__name__.removesuffix("Check").lower()):
            return super()._run(check, subject)


def sample(assignment: Assignment, count: int) -> list[Exhibit]:
    """Right and wrong exhibits in equal number, always the same."""
    rng = random.Random(assignment.number)
    exhibits = exhibits_of(CHECKOUT, assignment)
    right = [exhibit for exhibit in exhibits if exhibit.is_right]
    wrong = [exhibit for exhibit in exhibits if not exhibit.is_right]
    half = min(count // 2, len(right))
    return rng.sample(right, half) + rng.sample(wrong, count - half)


def measure(assignment: Assignment, count: int) -> float:
    """Print one assignment's lines; the seconds that a module takes."""
    course, kit = load_course(CHECKOUT), load_kit(KIT)
    in_boxes, in_checks, total = Ledger(), Ledger(), Ledger()
    workshop = Workshop(course, kit, TimedBox(in_boxes, kit.folder))
    grader = TimedGrader(workshop, References(workshop))
    object.__setattr__(grader, "ledger", in_checks)  # the class is frozen
    warm, *counted = sample(assignment, count + 1)
    for exhibit in [warm, *counted]:
        if exhibit is counted[0]:
            for ledger in (in_boxes, in_checks, total):
                ledger.seconds.clear()
        files = {path: SubmittedFile(text) for path, text in exhibit.files.items()}
        with total.time("all"):
            grader.grade(assignment, files)
    each = total.seconds["all"] / count
    print(f"{assignment.number} {assignment.module}: {each:.2f} s of processor time a module")
    print(f"    {in_checks.told(count)}")
    print(f"    {in_boxes.told(count)}", flush=True)
    return each


def main() -> None:
    parser = argparse.ArgumentParser(description="Says where the time of grading goes.")
    parser.add_argument("--assignment", metavar="LIST", type=lambda text: text.split(","))
    parser.add_argument("--count", type=int, default=4, help="modules of each assignment")
    arguments = parser.parse_args()
    chosen = [
        a
        for a in with_museum(load_course(CHECKOUT))
        if arguments.assignment is None or a.number in arguments.assignment
    ]
    seconds = [measure(assignment, arguments.count) for assignment in chosen]
    print(f"on average {sum(seconds) / len(seconds):.2f} s of processor time a module")


if __name__ == "__main__":
    main()
