"""What `run_autograder` does on Gradescope: grade the one submission, write results.json.

    python -m raybook_grader.gradescope.run ROOT             (ROOT is /autograder)
    python -m raybook_grader.gradescope.run ROOT --check     the course's own solution instead

The harness's own failure must not look like a student's: then there is no results.json at all, for
which Gradescope says that the autograder failed and gives no grade. The reason is in the output,
which only instructors see. Exit codes as `grade`'s: 0 graded, 3 the harness failed, 1 no sandbox.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import tempfile
from contextlib import closing
from pathlib import Path

from ..course import Course, load_course
from ..database import Database
from ..exports import Request, write_export
from ..grading.export import grades
from .bundle import CONFIG, Config, chosen, read_config
from .collect import NAME, collect
from .contents import FOLDER


def main() -> int:
    """Run one of the two commands above."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0] if __doc__ else "")
    parser.add_argument("root", type=Path)
    parser.add_argument("--check", action="store_true")
    arguments = parser.parse_args()
    root: Path = arguments.root.resolve()
    config = read_config(root / "source" / CONFIG)
    course = load_course(root / "source" / FOLDER)
    with tempfile.TemporaryDirectory(prefix="raybook-") as scratch:
        work = Path(scratch)
        if arguments.check:
            return check_solution(course, config, work)
        return grade_submission(root, course, config, work)


def grade_submission(root: Path, course: Course, config: Config, work: Path) -> int:
    """Grade ROOT/submission and write ROOT/results/results.json."""
    results = root / "results" / "results.json"
    results.unlink(missing_ok=True)
    owned = [path for a in chosen(course, config.assignments) for path in a.owned]
    code = _grade(course, config, collect(root / "submission", owned, work / "class"), work / "out")
    if code != 0:
        print(_FAILED)
        return code
    results.parent.mkdir(exist_ok=True)
    with closing(Database(work / "out")) as database:
        request = Request(
            "gradescope", results, assignments=config.assignments, hidden=config.hidden,
            submission=NAME,
        )  # fmt: skip
        write_export(database, work / "out", course, request)
    return 0


def check_solution(course: Course, config: Config, work: Path) -> int:
    """Grade the course's solution: it renders the references, and must get all points."""
    for assignment in chosen(course, config.assignments):
        for path in assignment.sources:
            file = work / "class" / NAME / path
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_bytes((course.root / path).read_bytes())
    (work / "class" / NAME).mkdir(parents=True, exist_ok=True)
    code = _grade(course, config, work / "class", work / "out")
    if code != 0:
        return code
    with closing(Database(work / "out")) as database:
        (found,) = grades(database)["submissions"]
    # Files that only tools can make are not in the course: nothing to check there.
    made = {a.number for a in course.assignments if not a.sources}
    lost = [m for m in found["modules"] if m["assignment"] not in made and m["verdict"] != "pass"]
    for module in lost:
        print(f"the course's own {module['module']}: {module['verdict']}, {module['message']}")
        for check in module["checks"]:
            print(f"  {check['name']}: {check['status']}, {check['message']}")
    return 1 if lost else 0


def _grade(course: Course, config: Config, folder: Path, out: Path) -> int:
    """The exit code of `grade`, one module at a time: a container may own half a processor."""
    command = [
        sys.executable, "-m", "raybook_grader", "grade", str(folder), "--out", str(out),
        "--course", str(course.root), "--assignment", ",".join(config.assignments), "--jobs", "1",
        *(["--unsafe"] if config.unsafe else []),
    ]  # fmt: skip
    code = subprocess.run(command, check=False).returncode
    if code == 3:
        _tell_faults(out)
    return code


def _tell_faults(out: Path) -> None:
    with closing(Database(out)) as database:
        for student in database.students():
            for number, result in student.results.items():
                if result is not None and result.traceback:
                    print(f"assignment {number}:\n{result.traceback}")


_FAILED = (
    "The grader failed, so there is no results.json and no grade, and not a zero either. "
    "The reason is above; once it is mended, run the autograder again."
)

if __name__ == "__main__":
    sys.exit(main())
