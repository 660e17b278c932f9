"""The command `override`: what a person decides about points, for ever, with a reason."""

from __future__ import annotations

import argparse
import getpass
import math
from contextlib import closing
from pathlib import Path
from typing import TYPE_CHECKING

from ..database import Database, Decision, Module
from ..errors import BadInput
from ..jobs.progress import plain
from ..reports import write_reports
from .export import write_grades
from .lock import alone_in
from .trouble import in_words

if TYPE_CHECKING:
    # argparse has no public name for what add_subparsers() returns.
    Subparsers = argparse._SubParsersAction[argparse.ArgumentParser]

_SAY = "expected STUDENT ASSIGNMENT POINTS, or --list, or --withdraw N"


def add_commands(subparsers: Subparsers) -> None:
    """Register `override` with raybook-grader."""
    command = subparsers.add_parser(
        "override",
        help="set the points of a student's module by hand",
        description="Sets the final points of a student's module, whatever the grader finds, or "
        "withdraws that. Both are written down with a reason and kept for ever: through "
        "regrading, --fresh, and when a submission goes and comes back.",
    )
    command.add_argument("out", metavar="DIR", type=Path, help="a folder that `grade` has written")
    command.add_argument("student", metavar="STUDENT", nargs="?", help="the submission's id")
    command.add_argument("assignment", metavar="ASSIGNMENT", nargs="?", help="such as 03")
    command.add_argument("points", metavar="POINTS", nargs="?", help="from 0 to the module's")
    command.add_argument("--reason", metavar="TEXT", help="shown to the student")
    command.add_argument("--by", metavar="NAME", help="who decides (default: who is logged in)")
    command.add_argument("--list", action="store_true", help="say all that was ever decided")
    command.add_argument("--withdraw", metavar="N", type=int, help="decision N holds no longer")
    command.set_defaults(handler=_override)


def _override(arguments: argparse.Namespace) -> int:
    # First, for a folder that is none must not be made.
    with in_words(arguments.out):
        Database(arguments.out).close()
    with (
        in_words(arguments.out),
        alone_in(arguments.out),
        closing(Database(arguments.out)) as database,
    ):
        if arguments.list:
            _list(database)
        elif arguments.withdraw is not None:
            _refuse_points(arguments)
            _withdraw(database, arguments)
        else:
            _decide(database, arguments)
    return 0


def _list(database: Database) -> None:
    decisions = database.decisions()
    known = {student.id for student in database.students()}
    for decision in decisions:
        gone = "" if decision.student in known else " (has no submission now)"
        print(plain(_line(decision) + gone))
    if not decisions:
        print("nothing was ever decided by hand")


def _line(decision: Decision) -> str:
    about = f"{decision.number}. {decision.student} {decision.assignment}"
    if decision.points is None:
        what = f"withdraws {decision.withdraws}"
    else:
        what = f"{decision.points:g} points" + ("" if decision.holds else " (no longer holds)")
    return f"{about}: {what}, by {decision.by}, {decision.at}: {decision.reason}"


def _decide(database: Database, arguments: argparse.Namespace) -> None:
    if arguments.points is None:
        raise BadInput(f"override: too few arguments, {_SAY}")
    students = {student.id: student for student in database.students()}
    if arguments.student not in students:
        raise BadInput(f"override: no student {arguments.student!r}, expected one of this class")
    own = students[arguments.student].results
    modules = {module.number: module for module in database.modules() if module.number in own}
    if arguments.assignment not in modules:
        expected = ", ".join(modules)
        raise BadInput(f"override: no assignment {arguments.assignment!r}, expected {expected}")
    module = modules[arguments.assignment]
    points = _points(arguments.points, module)
    decision = database.decide(
        arguments.student, module.number, points, _reason(arguments), _who(arguments)
    )
    _publish(database, arguments.out, decision)


def _withdraw(database: Database, arguments: argparse.Namespace) -> None:
    found = {d.number: d for d in database.decisions() if d.points is not None}
    withdrawn = {d.withdraws for d in database.decisions()}
    if arguments.withdraw not in found or arguments.withdraw in withdrawn:
        raise BadInput(
            f"override --withdraw {arguments.withdraw}: no decision of that number holds, "
            "expected one that --list shows"
        )
    decision = database.withdraw(arguments.withdraw, _reason(arguments), _who(arguments))
    _publish(database, arguments.out, decision)


def _publish(database: Database, out: Path, decision: Decision) -> None:
    """Say what was decided, and write the grades anew if they were complete before."""
    print(plain(_line(decision)))
    if not database.published():
        print("it counts as soon as `grade` has graded everything")
        return
    known = {student.id for student in database.students()}
    if decision.student in known:
        student = database.student(decision.student)
        result = student.results.get(decision.assignment)
        score = "?" if result is None or result.score is None else f"{result.score:g}"
        print(plain(f"{student.id} {decision.assignment}: {score} points now"))
    print(f"grades: {write_grades(database, out)}\nreport: {write_reports(database, out)}")


def _points(text: str, module: Module) -> float:
    expected = f"a number from 0 to {module.points:g}"
    try:
        points = float(text)
    except ValueError:
        raise BadInput(f"override: POINTS is {text!r}, expected {expected}") from None
    if not math.isfinite(points) or not 0 <= points <= module.points:
        raise BadInput(f"override: POINTS is {text}, expected {expected}")
    return round(points, 2)


def _reason(arguments: argparse.Namespace) -> str:
    reason = (arguments.reason or "").strip()
    if not reason:
        raise BadInput("override: --reason is missing, expected why, in words for the student")
    return str(reason)


def _who(arguments: argparse.Namespace) -> str:
    if arguments.by is not None and arguments.by.strip():
        return str(arguments.by.strip())
    try:
        return getpass.getuser()
    except (KeyError, OSError):
        raise BadInput("override: nobody is logged in, expected --by NAME") from None


def _refuse_points(arguments: argparse.Namespace) -> None:
    if arguments.student is not None:
        raise BadInput("override --withdraw N: takes no STUDENT, ASSIGNMENT or POINTS")
