"""The command `calibrate`."""

from __future__ import annotations

import argparse
import json
import os
from pathlib import Path
from typing import TYPE_CHECKING

from rich.console import Console

from ..checks.program import Workshop
from ..checks.reference import References
from ..checks.shipping import pictures_of, ship, sweep
from ..course import Assignment, load_course
from ..errors import BadInput
from ..files import write_text
from ..kit import load_kit
from ..museum.visit import with_museum
from ..sandbox import Box, require
from .judging import Compiler
from .run import Order, calibrate
from .table import is_good, summary, to_json, to_markdown

if TYPE_CHECKING:
    # argparse has no public name for what add_subparsers() returns.
    Subparsers = argparse._SubParsersAction[argparse.ArgumentParser]

_CHECKOUT = Path(__file__).resolve().parents[3]
_LOOKS = 5


def add_commands(subparsers: Subparsers) -> None:
    """Register `calibrate` and `references` with raybook-grader."""
    _add_references(subparsers)
    command = subparsers.add_parser(
        "calibrate",
        help="judge all that is known to be right or wrong, and print the confusion table",
        description="Judges every alternative, mistake and twin with all checks, counts how often "
        "right pictures fail by chance, and how often the diagnosis names the right mistake. "
        "The table is written to build/calibration/. Stopped at any point, the same command "
        "goes on from there.",
        epilog="Exit code: 0 all is as it should be; 1 something is not; 2 bad usage.",
    )
    command.add_argument("--module", metavar="M", help="only this one: its name or its number")
    command.add_argument("--json", metavar="FILE", type=Path, help="write the figures here, too")
    command.add_argument(
        "--full", action="store_true", help=f"judge each wrong picture {_LOOKS} times"
    )
    command.add_argument("--cc", metavar="CC", help="the compiler of the students' modules")
    command.add_argument("--optimisation", metavar="FLAG", help="their level, such as -O0")
    command.add_argument(
        "--jobs", metavar="N", type=int, default=len(os.sched_getaffinity(0)),
        help="exhibits judged at once (default: one a core, here %(default)s)",
    )  # fmt: skip
    command.set_defaults(handler=_calibrate)


def _add_references(subparsers: Subparsers) -> None:
    command = subparsers.add_parser(
        "references",
        help="render the statistics of the references that are committed with the course",
        description="Renders what is missing in grader/statistics/, and removes what no image "
        "check asks for any more.",
    )
    command.set_defaults(handler=_references)


def _references(arguments: argparse.Namespace) -> int:
    require()
    course = load_course(_CHECKOUT)
    references = References(Workshop(course, load_kit(_CHECKOUT / "build" / "kit"), Box()))
    pictures = pictures_of(course.assignments)
    for picture in pictures:
        done = ship(references, picture)
        print(f"{'rendered' if done else 'there'}: {references.shipped_file(picture).name}")
    for name in sweep(references, pictures):
        print(f"removed: {name}")
    return 0


def _calibrate(arguments: argparse.Namespace) -> int:
    require()
    console = Console(stderr=True)
    chosen = _chosen(with_museum(load_course(_CHECKOUT)), arguments.module)
    order = Order(
        root=_CHECKOUT,
        kit=_CHECKOUT / "build" / "kit",
        compiler=Compiler(arguments.cc, arguments.optimisation),
        looks=_LOOKS if arguments.full else 1,
        jobs=max(1, arguments.jobs),
    )
    tables = calibrate(order, chosen, console)
    figures = json.dumps(to_json(tables), indent=1) + "\n"
    folder = _CHECKOUT / "build" / "calibration" / order.compiler.name
    folder.mkdir(parents=True, exist_ok=True)
    write_text(folder / "calibration.json", figures)
    write_text(folder / "table.md", to_markdown(tables))
    if arguments.json:
        write_text(arguments.json, figures)
    print(f"table: {folder / 'table.md'}")
    print(summary(tables))
    for row in (row for table in tables for row in table.rows if not row.as_meant):
        print(f"not as meant: {row.told}")
    return 0 if is_good(tables) else 1


def _chosen(assignments: list[Assignment], name: str | None) -> list[Assignment]:
    chosen = [a for a in assignments if name is None or name in (a.module, a.number)]
    if not chosen:
        known = ", ".join(a.module for a in assignments)
        raise BadInput(f"--module {name!r}: no such module, expected one of {known}")
    return chosen
