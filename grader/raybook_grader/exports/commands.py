"""The command `export`, and what `grade --export` does."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from contextlib import closing
from pathlib import Path
from typing import TYPE_CHECKING

from ..checks.words import clean
from ..course import Course, load_course
from ..database import Database
from ..errors import BadInput
from ..grading.trouble import in_words
from .gradescope import VISIBILITIES
from .write import FORMATS, Request, Written, check_request, write_export

if TYPE_CHECKING:
    # argparse has no public name for what add_subparsers() returns.
    Subparsers = argparse._SubParsersAction[argparse.ArgumentParser]

_CHECKOUT = Path(__file__).resolve().parents[3]
_TOLD = 10


def add_commands(subparsers: Subparsers) -> None:
    """Register `export` with raybook-grader."""
    command = subparsers.add_parser(
        "export",
        help="write the grades for Canvas, Moodle, Gradescope or a spreadsheet",
        description="Writes the grades in DIR, which `grade` has made, in another program's "
        "format. A module whose grading failed has no score: it is written as empty, never as "
        "zero, and the command says how many there are.",
        epilog="Exit code: 0 written; 3 written, but some modules have no score; 2 bad usage.",
    )
    command.add_argument("out", metavar="DIR", type=Path, help="a folder that `grade` has written")
    command.add_argument("--format", choices=FORMATS, required=True, help="whose format")
    command.add_argument(
        "--output", metavar="FILE", type=Path,
        help="where to (default: DIR/exports/); for gradescope a folder",
    )  # fmt: skip
    command.add_argument(
        "--roster", metavar="FILE", type=Path,
        help="canvas: the gradebook exported by Canvas (without it, submissions are taken to be "
        "named by login); moodle: the grading worksheet",
    )  # fmt: skip
    command.add_argument(
        "--match", metavar="COLUMN",
        help="the roster's column that submissions are named by (default: canvas: SIS Login ID, "
        "SIS User ID or ID; moodle: Identifier, Email address, ID number, Username or Full name)",
    )  # fmt: skip
    command.add_argument(
        "--assignment", metavar="LIST", type=_list,
        help="only these, such as 01,03; the score is then their sum, optional ones included",
    )  # fmt: skip
    command.add_argument(
        "--column", metavar="NN=NAME", type=_pair, action="append", default=[],
        help="canvas: what assignment NN is called there (default: its number and title)",
    )  # fmt: skip
    command.add_argument(
        "--scale", action="store_true",
        help="canvas, moodle: scale scores to what the assignment is worth there; without it, a "
        "difference is an error",
    )  # fmt: skip
    command.add_argument(
        "--hidden", choices=VISIBILITIES, default=VISIBILITIES[0],
        help="gradescope: when students see hidden checks (default: %(default)s)",
    )  # fmt: skip
    command.add_argument(
        "--submission", metavar="ID", help="gradescope: this one only, into the file --output"
    )
    command.add_argument(
        "--course", metavar="DIR", type=Path, default=_CHECKOUT,
        help="the checkout that says which checks are hidden (default: the one of this program)",
    )  # fmt: skip
    command.set_defaults(handler=_export)


def export_list(text: str) -> tuple[Request, ...]:
    """The value of `grade --export`: "csv,canvas=roster.csv"; an argparse type."""
    requests = []
    for item in _list(text):
        name, _, roster = item.partition("=")
        if name not in FORMATS:
            raise argparse.ArgumentTypeError(f"{name!r} is none of {', '.join(FORMATS)}")
        requests.append(Request(name, roster=Path(roster) if roster else None))
    return tuple(requests)


def check_exports(requests: Sequence[Request]) -> None:
    """Fault what would fail after hours of grading."""
    for request in requests:
        check_request(request)


def write_exports(out: Path, course: Course, requests: Sequence[Request]) -> bool:
    """Write all of them into ``out``/exports and tell about each; False if one cannot be."""
    if not requests:
        return True
    complete = True
    with in_words(out), closing(Database(out)) as database:
        for request in requests:
            try:
                _tell(request, write_export(database, out, course, request))
            except BadInput as fault:
                print(f"{request.format}: not written: {fault}")
                complete = False
    return complete


def _export(arguments: argparse.Namespace) -> int:
    request = Request(
        format=arguments.format,
        output=arguments.output,
        roster=arguments.roster,
        key=arguments.match,
        assignments=arguments.assignment,
        columns=dict(arguments.column),
        scale=arguments.scale,
        hidden=arguments.hidden,
        submission=arguments.submission,
    )
    course = load_course(arguments.course.resolve())
    with in_words(arguments.out), closing(Database(arguments.out)) as database:
        written = write_export(database, arguments.out, course, request)
    _tell(request, written)
    return 3 if written.unknown else 0


def _tell(request: Request, written: Written) -> None:
    print(f"{request.format}: {written.path}")
    for note in written.notes:
        print(f"  {clean(note, 1)}")
    if written.unknown:
        shown = clean(", ".join(written.unknown[:_TOLD]), 1)
        more = len(written.unknown) - _TOLD
        print(
            f"  no score, so left empty: {len(written.unknown)} ({shown}"
            + (f" and {more} more)" if more > 0 else ")")
        )


def _list(text: str) -> tuple[str, ...]:
    items = tuple(item.strip() for item in text.split(",") if item.strip())
    if not items:
        raise argparse.ArgumentTypeError("empty, expected values with commas between them")
    return items


def _pair(text: str) -> tuple[str, str]:
    number, sign, name = text.partition("=")
    if not (number and sign and name):
        raise argparse.ArgumentTypeError(f"is {text!r}, expected NN=NAME")
    return number, name
