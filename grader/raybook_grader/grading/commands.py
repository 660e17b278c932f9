"""The commands `grade` and `report`."""

from __future__ import annotations

import argparse
import os
from contextlib import closing
from pathlib import Path
from typing import TYPE_CHECKING

from rich.console import Console

from ..course import load_course
from ..database import Database
from ..errors import BadInput
from ..exports.commands import check_exports, export_list, write_exports
from ..jobs.dask_client import ClusterLost, connect
from ..jobs.progress import progress
from ..policy import find_policy
from ..reports import write_reports
from ..sandbox import SandboxUnavailable, require
from .job import Worker
from .plan import Order
from .run import grade_class
from .trouble import in_words

if TYPE_CHECKING:
    # argparse has no public name for what add_subparsers() returns.
    Subparsers = argparse._SubParsersAction[argparse.ArgumentParser]

_CHECKOUT = Path(__file__).resolve().parents[3]


def add_commands(subparsers: Subparsers) -> None:
    """Register `grade` and `report` with raybook-grader."""
    _add_grade(subparsers)
    _add_report(subparsers)


def _add_grade(subparsers: Subparsers) -> None:
    command = subparsers.add_parser(
        "grade",
        help="grade a folder of submissions",
        description="Grades every submission in a folder. Each is a folder or an archive (.zip, "
        ".tar.gz) with the files that an assignment owns at their usual paths. Stopped at any "
        "point, the same command goes on from there; what has not changed is not done again.",
        epilog="Exit code: 0 all graded, whatever the scores; 3 the grader itself failed in some "
        "module, which then has no score; 2 bad usage; 130 interrupted.",
    )
    command.add_argument("submissions", metavar="SUBMISSIONS", type=Path, help="the folder")
    command.add_argument(
        "--out", metavar="DIR", type=Path, required=True,
        help="where the results go: grades.json, index.html, students/ and grades.sqlite",
    )  # fmt: skip
    command.add_argument(
        "--assignment", metavar="LIST", type=_list, help="only these, such as 01,03"
    )
    command.add_argument(
        "--jobs", metavar="N", type=_positive, default=len(os.sched_getaffinity(0)),
        help="modules graded at once (default: one a core, here %(default)s)",
    )  # fmt: skip
    command.add_argument(
        "--scheduler", metavar="ADDRESS",
        help="grade on the workers of the Dask scheduler there, such as tcp://10.0.0.1:8786; "
        "--jobs is then for what is made ready here (docs/instructor/cluster.md)",
    )  # fmt: skip
    command.add_argument("--fresh", action="store_true", help="forget all earlier results in DIR")
    command.add_argument(
        "--regrade", metavar="LIST", type=_list, default=(),
        help="do these submissions again, or 'all', and say what would change, for whom",
    )  # fmt: skip
    command.add_argument(
        "--apply", action="store_true",
        help="apply what would change in published grades; otherwise it is only said "
        "(on a terminal: asked)",
    )  # fmt: skip
    command.add_argument(
        "--policy", metavar="FILE", type=Path,
        help="deadlines, late days and extensions (default: SUBMISSIONS/course.toml if it is "
        "there; docs/instructor/policies.md)",
    )  # fmt: skip
    command.add_argument(
        "--course", metavar="DIR", type=Path, default=_CHECKOUT,
        help="the checkout whose assignments are graded (default: the one of this program)",
    )  # fmt: skip
    command.add_argument(
        "--kit", metavar="DIR", type=Path, help="the reference's objects (default: its build/kit)"
    )
    command.add_argument(
        "--unsafe", action="store_true",
        help="grade without the sandbox where this machine cannot make one: limits only. Never "
        "for strangers' code; every result and report says so",
    )  # fmt: skip
    command.add_argument(
        "--export", metavar="LIST", type=export_list, default=(),
        help="also write DIR/exports, such as csv,canvas=roster.csv (see `export`)",
    )  # fmt: skip
    command.set_defaults(handler=_grade)


def _add_report(subparsers: Subparsers) -> None:
    command = subparsers.add_parser(
        "report",
        help="write the reports of a graded class again",
        description="Writes index.html for the instructor, and in students/ a page for each "
        "submission and each of its modules, from the results in DIR.",
    )
    command.add_argument("out", metavar="DIR", type=Path, help="a folder that `grade` has written")
    command.set_defaults(handler=_report)


def _grade(arguments: argparse.Namespace) -> int:
    console = Console()
    root = arguments.course.resolve()
    course = load_course(root)
    check_exports(arguments.export)
    unsafe = _is_unsafe(arguments.unsafe, console)
    if unsafe and arguments.scheduler is not None:
        raise BadInput("--unsafe is for this machine only, expected no --scheduler beside it")
    if arguments.scheduler is not None:
        connect(arguments.scheduler).close()
    order = Order(
        submissions=arguments.submissions,
        out=arguments.out,
        assignments=arguments.assignment,
        workers=arguments.jobs,
        fresh=arguments.fresh,
        regrade=arguments.regrade,
        scheduler=arguments.scheduler,
        apply=arguments.apply,
        policy=find_policy(arguments.submissions, arguments.policy),
    )
    worker = Worker(root, (arguments.kit or root / "build" / "kit").resolve(), unsafe)
    try:
        with in_words(order.out):
            outcome = grade_class(course, worker, order, console)
    except KeyboardInterrupt:
        hint = " (without --fresh)" if order.fresh else ""
        print(f"\nstopped; what is graded so far is kept. Go on with the same command{hint}.")
        return 130
    except ClusterLost as fault:
        print(f"\n{fault}\nWhat is graded so far is kept. Go on with the same command.")
        return 1
    if not outcome.is_held:
        print(f"grades: {outcome.grades}\nreport: {outcome.report}")
    if unsafe:
        _warn(console, "these results are unsafe: the students' code ran without a sandbox")
    exported = write_exports(order.out, course, arguments.export)
    if not outcome.internal_errors:
        return 0 if exported else 2
    print(
        f"internal errors: {outcome.internal_errors} modules have no score because the grader "
        "failed; the report shows them first, and the same command tries them again"
    )
    return 3


def _is_unsafe(allowed: bool, console: Console) -> bool:
    """Whether to grade without walls: only if told so, and only if there is no other way."""
    try:
        require()
    except SandboxUnavailable as reason:
        if not allowed:
            raise SandboxUnavailable(
                f"{reason}\n`raybook-grader doctor` tells more. To grade without a sandbox all the "
                "same, which is\nsafe for nobody but code that you know, say --unsafe."
            ) from None
        _warn(console, f"UNSAFE: {reason}\ngrading WITHOUT a sandbox: limits, a scratch folder "
              "and nothing else")  # fmt: skip
        return True
    if allowed:
        console.print("--unsafe is not needed here: this machine makes boxes, and they are used")
    return False


def _warn(console: Console, words: str) -> None:
    for line in words.splitlines():
        progress(console, "", 0).say(f"!! {line}", "bold red")


def _report(arguments: argparse.Namespace) -> int:
    with in_words(arguments.out), closing(Database(arguments.out)) as database:
        print(f"report: {write_reports(database, arguments.out)}")
    return 0


def _list(text: str) -> tuple[str, ...]:
    items = tuple(item.strip() for item in text.split(",") if item.strip())
    if not items:
        raise argparse.ArgumentTypeError("empty, expected values with commas between them")
    return items


def _positive(text: str) -> int:
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"is {text!r}, expected a whole number above 0")
    return int(text)
