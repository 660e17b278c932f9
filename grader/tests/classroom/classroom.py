"""A class of made-up students, graded from archives to exports, with every score foretold.

    build/venv/bin/python grader/tests/classroom/classroom.py 200

Each student hands in a random mix of the reference, the museum's alternatives, mistakes and twins,
stubs and broken files. What a module must score is found beforehand by judging its exhibit alone,
in processes of its own (`raybook-grader calibrate` keeps such results, and they are taken from
there). Then the class is graded by the real command, and every single score is compared.
"""

from __future__ import annotations

import argparse
import csv
import json
import os
import resource
import shlex
import shutil
import subprocess
import sys
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from rich.console import Console
from students import Student, make_students, write_students

from raybook_grader.calibration.judging import Bench, Compiler, Task, judge_all
from raybook_grader.checks.reference import References
from raybook_grader.checks.shipping import pictures_of
from raybook_grader.course import Assignment, load_course
from raybook_grader.grading.job import Worker
from raybook_grader.grading.key import Keys
from raybook_grader.grading.learn import learn
from raybook_grader.kit import load_kit
from raybook_grader.submissions import find_submissions

CHECKOUT = Path(__file__).resolve().parents[3]
KIT = CHECKOUT / "build" / "kit"
_SHOWN = 30


@dataclass(frozen=True)
class Spent:
    """Seconds by the clock, and of all processors together."""

    wall: float
    cpu: float


@dataclass(frozen=True)
class Difference:
    """A score that is not as foretold."""

    student: str
    version: str
    foretold: float | None
    found: float | None

    def __str__(self) -> str:
        return f"{self.student}: {self.version}: foretold {self.foretold}, found {self.found}"


def main() -> int:
    arguments = _arguments()
    course = load_course(CHECKOUT)
    only = arguments.assignment
    assignments = [
        a for a in course.assignments if a.is_graded and (only is None or a.number in only)
    ]
    students = make_students(course, assignments, arguments.students, arguments.seed)
    submissions, grades = arguments.out / "submissions", arguments.out / "grades"
    _clear(arguments.out)
    forms = write_students(students, submissions, arguments.seed)
    modules, different = _count(submissions, assignments)
    print(f"class: {', '.join(f'{count} {form}' for form, count in sorted(forms.items()))}")
    print(f"modules: {modules}, of which {different} are different", flush=True)
    _make_ready(assignments, arguments.jobs)
    judged = _judge_alone(students, arguments.jobs)
    spent = _grade(submissions, grades, assignments, arguments)
    _tell_speed(spent, modules, different)
    return _compare(students, judged, grades)


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description="Grades a made-up class and checks every score.")
    parser.add_argument("students", metavar="N", type=int, nargs="?", default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--assignment", metavar="LIST", type=lambda text: text.split(","))
    parser.add_argument("--jobs", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("--out", type=Path, default=CHECKOUT / "build" / "class")
    parser.add_argument(
        "--grade", metavar="ARGS", type=shlex.split, default=["--export", "csv,gradescope"],
        help='further arguments of `grade` (default: "--export csv,gradescope")',
    )  # fmt: skip
    return parser.parse_args()


def _clear(out: Path) -> None:
    """An empty folder; only what an earlier run has made is removed."""
    mark = out / ".made-up-class"
    if out.exists() and any(out.iterdir()) and not mark.is_file():
        sys.exit(f"--out {out}: holds something else, expected an empty or a new folder")
    shutil.rmtree(out, ignore_errors=True)
    out.mkdir(parents=True)
    mark.touch()


def _count(submissions: Path, assignments: Sequence[Assignment]) -> tuple[int, int]:
    """Modules with files in them, and how many of these are work of their own."""
    keys = Keys(load_course(CHECKOUT), load_kit(KIT))
    owned = [path for assignment in assignments for path in assignment.owned]
    found, _ = find_submissions(submissions, owned)
    handed_in = [
        keys.key(assignment, files)
        for submission in found
        for assignment in assignments
        if (files := {p: f for p, f in submission.files.items() if p in assignment.owned})
    ]
    return len(handed_in), len(set(handed_in))


def _make_ready(assignments: Sequence[Assignment], jobs: int) -> None:
    """What a course does once, at its calibration: references, and what mistakes look like."""
    before = _clock()
    worker = Worker(CHECKOUT, KIT)
    references = References(worker.workshop())
    for picture in pictures_of(assignments):
        references.statistics(picture)
    learn(worker, {a.number for a in assignments}, jobs, Console(stderr=True))
    print(f"made ready, which a course does once: {_told(_since(before))}", flush=True)


def _judge_alone(students: Sequence[Student], jobs: int) -> dict[str, float | None]:
    """The score of each exhibit in the class, by its name."""
    before = _clock()
    versions = [version for student in students for version in student.modules.values()]
    exhibits = {v.exhibit.name: v.exhibit for v in versions if v.exhibit is not None}
    bench = Bench(CHECKOUT, KIT, Compiler())
    tasks = [Task(exhibit) for exhibit in exhibits.values()]
    results = judge_all(bench, tasks, jobs, Console(stderr=True))
    print(f"foretold: {len(tasks)} exhibits judged alone: {_told(_since(before))}", flush=True)
    return {task.exhibit.name: results[task.name].score for task in tasks}


def _grade(
    submissions: Path,
    grades: Path,
    assignments: Sequence[Assignment],
    arguments: argparse.Namespace,
) -> Spent:
    """Grade by the command that an instructor types; its words are kept beside the grades."""
    command = [
        sys.executable, "-m", "raybook_grader", "grade", str(submissions), "--out", str(grades),
        "--jobs", str(arguments.jobs), "--assignment", ",".join(a.number for a in assignments),
        *arguments.grade,
    ]  # fmt: skip
    before = _clock()
    log = arguments.out / "grade.log"
    with log.open("w") as said:
        ended = subprocess.run(command, stdout=said, stderr=subprocess.STDOUT, check=False)
    if ended.returncode:
        sys.exit(f"{' '.join(command)}\nended with {ended.returncode}; what it said is in {log}")
    return _since(before)


def _tell_speed(spent: Spent, modules: int, different: int) -> None:
    print(
        f"graded, from archives to exports: {_told(spent)}; {different} modules graded and "
        f"{modules - different} known by their hash; {different / spent.wall:.2f} a second, "
        f"{spent.cpu / different:.2f} s of processor time each"
    )


def _compare(students: Sequence[Student], judged: Mapping[str, float | None], out: Path) -> int:
    """Every score in grades.json, and in the table of the exports if there is one."""
    found = {"grades.json": _graded(out / "grades.json")}
    table = out / "exports" / "grades.csv"
    if table.is_file():
        found["exports/grades.csv"] = _exported(table)
    bad = 0
    for name, scores in found.items():
        pairs = [
            Difference(student.name, version.name, student.score(number, judged), score)
            for student in students
            for number, version in student.modules.items()
            for score in [scores.get((student.name, number))]
        ]
        wrong = [pair for pair in pairs if pair.foretold is None or pair.foretold != pair.found]
        for pair in wrong[:_SHOWN]:
            print(pair)
        print(f"{name}: {len(pairs) - len(wrong)} of {len(pairs)} scores as foretold")
        bad += len(wrong) + (len(scores) != len(pairs))
    return 1 if bad else 0


def _graded(file: Path) -> Mapping[tuple[str, str], float | None]:
    """Scores by student and assignment."""
    values = json.loads(file.read_text(encoding="utf-8"))
    return {
        (submission["id"], module["assignment"]): module["score"]
        for submission in values["submissions"]
        for module in submission["modules"]
    }


def _exported(file: Path) -> Mapping[tuple[str, str], float | None]:
    """The same from a table, whose columns are called "01 triangle"."""
    with file.open(encoding="utf-8", newline="") as stream:
        rows = list(csv.DictReader(stream))
    return {
        (row["submission"], column.split()[0]): float(score) if score else None
        for row in rows
        for column, score in row.items()
        if column[:2].isdecimal() and not column.endswith(" verdict")
    }


def _clock() -> Spent:
    """The clock, and what this process and its children have used."""
    used = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return Spent(time.monotonic(), sum(one.ru_utime + one.ru_stime for one in used))


def _since(before: Spent) -> Spent:
    now = _clock()
    return Spent(now.wall - before.wall, now.cpu - before.cpu)


def _told(spent: Spent) -> str:
    return f"{spent.wall:.0f} s, {spent.cpu:.0f} s of processor time"


if __name__ == "__main__":
    sys.exit(main())
