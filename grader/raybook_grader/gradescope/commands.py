"""The command `gradescope-bundle`."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from ..course import load_course
from ..exports.gradescope import VISIBILITIES
from .bundle import Config, chosen, write_bundle

if TYPE_CHECKING:
    # argparse has no public name for what add_subparsers() returns.
    Subparsers = argparse._SubParsersAction[argparse.ArgumentParser]

_CHECKOUT = Path(__file__).resolve().parents[3]


def add_commands(subparsers: Subparsers) -> None:
    """Register `gradescope-bundle` with raybook-grader."""
    command = subparsers.add_parser(
        "gradescope-bundle",
        help="write an autograder that Gradescope can run",
        description="Writes a zip for Gradescope's Configure Autograder page, with base image "
        "Ubuntu 24.04 or newer. It holds the solutions and hidden checks of its assignments: "
        "Gradescope keeps it from students, and so must you.",
        epilog="Students' programs run in a sandbox that needs user namespaces. Where Gradescope's "
        "containers forbid them, the image's build stops with that reason (`doctor` tells more). "
        "With --unsafe it goes on without a sandbox there: a student's program can then read the "
        "hidden checks and write its own grade.",
    )
    command.add_argument("out", metavar="OUT.zip", type=Path, help="the file to write")
    command.add_argument(
        "--assignment", metavar="LIST", type=_list, help="only these, such as 03 (default: all)"
    )
    command.add_argument(
        "--hidden", choices=VISIBILITIES, default=VISIBILITIES[0],
        help="when students see hidden checks (default: %(default)s)",
    )  # fmt: skip
    command.add_argument(
        "--unsafe",
        action="store_true",
        help="grade even where no sandbox can be made; read below what that means",
    )
    command.add_argument(
        "--course", metavar="DIR", type=Path, default=_CHECKOUT,
        help="the checkout that is packed (default: the one of this program)",
    )  # fmt: skip
    command.set_defaults(handler=_bundle)


def _bundle(arguments: argparse.Namespace) -> int:
    course = load_course(arguments.course.resolve())
    numbers = tuple(a.number for a in chosen(course, arguments.assignment))
    config = Config(numbers, arguments.hidden, arguments.unsafe)
    written = write_bundle(arguments.out, course, config)
    size = arguments.out.stat().st_size / 1e6
    print(f"{arguments.out}: assignments {', '.join(numbers)}; {len(written.files)} files, "
          f"{size:.1f} MB")  # fmt: skip
    if written.left_out:
        print(f"left out, because git does not track them: {', '.join(written.left_out)}")
    if config.unsafe:
        print("where no sandbox can be made, students' programs can read the hidden checks")
    return 0


def _list(text: str) -> tuple[str, ...]:
    items = tuple(item.strip() for item in text.split(",") if item.strip())
    if not items:
        raise argparse.ArgumentTypeError("empty, expected values with commas between them")
    return items
