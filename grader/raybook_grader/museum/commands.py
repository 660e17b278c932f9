"""The command `museum`."""

from __future__ import annotations

import argparse
import os
from pathlib import Path
from typing import TYPE_CHECKING

from rich.console import Console

from ..course import load_course
from ..errors import BadInput
from ..sandbox import require
from .exhibits import exhibits_of
from .table import lines_of, summary
from .visit import Visitor, visit_all, with_museum

if TYPE_CHECKING:
    # argparse has no public name for what add_subparsers() returns.
    Subparsers = argparse._SubParsersAction[argparse.ArgumentParser]

_CHECKOUT = Path(__file__).resolve().parents[3]


def add_commands(subparsers: Subparsers) -> None:
    """Register `museum` with raybook-grader."""
    command = subparsers.add_parser(
        "museum",
        help="judge all alternatives and mistakes, and say which public tests catch which",
        description="Judges every exhibit of assignments/*/alternatives and mistakes alone and "
        "compares what fails with what its label announces.",
        epilog="Exit code: 0 all is as announced; 1 there were surprises; 2 bad usage.",
    )
    command.add_argument("--assignment", metavar="LIST", help="only these, such as 01,03")
    command.add_argument("--images", action="store_true", help="pictures, too: many minutes")
    command.add_argument(
        "--jobs", metavar="N", type=int, default=len(os.sched_getaffinity(0)),
        help="exhibits judged at once (default: one a core, here %(default)s)",
    )  # fmt: skip
    command.set_defaults(handler=_museum)


def _museum(arguments: argparse.Namespace) -> int:
    require()
    visitor = Visitor(_CHECKOUT, _CHECKOUT / "build" / "kit", arguments.images)
    assignments = with_museum(load_course(_CHECKOUT))
    only = arguments.assignment.split(",") if arguments.assignment else None
    if only is not None and (unknown := set(only) - {a.number for a in assignments}):
        raise BadInput(f"no museum for {', '.join(sorted(unknown))}")
    shown = [a for a in assignments if only is None or a.number in only]
    exhibits = [exhibit for a in shown for exhibit in exhibits_of(_CHECKOUT, a)]
    visits = visit_all(visitor, exhibits, max(1, arguments.jobs), Console(stderr=True))
    for a in shown:
        own = [visits[e.name] for e in exhibits if e.assignment == a.number]
        print("\n".join(lines_of(f"{a.number} {a.module}", own)), end="\n\n")
    print(summary(list(visits.values())))
    return 0 if all(v.as_announced for v in visits.values()) else 1
