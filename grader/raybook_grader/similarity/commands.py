"""The command `similarity`."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from rich.console import Console

from ..checks.words import clean
from ..course import load_course
from ..errors import BadInput
from ..jobs.progress import progress
from ..submissions import Submission, find_submissions, latest
from .settings import THRESHOLD

if TYPE_CHECKING:
    # argparse has no public name for what add_subparsers() returns.
    Subparsers = argparse._SubParsersAction[argparse.ArgumentParser]

_CHECKOUT = Path(__file__).resolve().parents[3]
_TOLD = 20


def add_commands(subparsers: Subparsers) -> None:
    """Register `similarity` with raybook-grader."""
    command = subparsers.add_parser(
        "similarity",
        help="find submissions that are alike",
        description="Compares every submission's modules with each other and with earlier years, "
        "without what the course handed out. Other names, comments and layout change nothing. "
        "Writes index.html, with the texts side by side, and similarity.json.",
        epilog="A pair in the report is a question, not a verdict: look at it before you ask it.",
    )
    command.add_argument("submissions", metavar="SUBMISSIONS", type=Path, help="the folder")
    command.add_argument(
        "--out", metavar="DIR", type=Path, required=True, help="where the report goes"
    )
    command.add_argument(
        "--earlier", metavar="DIR", type=Path, action="append", default=[],
        help="an earlier year's submissions, to compare this year's with (may be repeated)",
    )  # fmt: skip
    command.add_argument(
        "--threshold", metavar="SHARE", type=_share, default=THRESHOLD,
        help="show pairs that have this share of a module in common (default: %(default)s)",
    )  # fmt: skip
    command.add_argument(
        "--course", metavar="DIR", type=Path, default=_CHECKOUT,
        help="the checkout that was handed out (default: the one of this program)",
    )  # fmt: skip
    command.set_defaults(handler=_similarity)


def _similarity(arguments: argparse.Namespace) -> int:
    # copydetect brings a plotting library along; no other command has to wait for it.
    from .report import write_report
    from .search import search

    course = load_course(arguments.course.resolve())
    # Two submissions of one student are alike; the earlier ones are not looked at.
    ours = latest(find_submissions(arguments.submissions, course.sources)[0])
    earlier = _earlier(arguments.earlier, course.sources)
    try:
        arguments.out.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise BadInput(f"{arguments.out}: {error.strerror}, expected a folder") from error
    say = progress(Console(stderr=True), "", 0).say
    findings = search(course, ours, earlier, arguments.threshold, say)
    page, values = write_report(arguments.out, course.name, findings, arguments.threshold)
    pairs = [(found, pair) for found in findings for pair in found.alike]
    for found, pair in pairs[:_TOLD]:
        a, b = clean(pair.a.owner.name, 1), clean(pair.b.owner.name, 1)
        module = f"{found.assignment.number} {found.assignment.module}"
        print(f"{module}: {a} and {b}: {pair.similarity:.0%}")
    if len(pairs) > _TOLD:
        print(f"... and {len(pairs) - _TOLD} more")
    print(f"{len(pairs)} pairs of {sum(found.pairs for found in findings)} have "
          f"{arguments.threshold:.0%} of a module or more in common")  # fmt: skip
    print(f"report: {page}\nsimilarity: {values}")
    return 0


def _earlier(folders: Sequence[Path], owned: Sequence[str]) -> dict[str, list[Submission]]:
    """By the folders' names, or their paths where two have the same name."""
    names = [folder.resolve().name for folder in folders]
    found = {}
    for folder, name in zip(folders, names, strict=True):
        key = name if names.count(name) == 1 else str(folder)
        found[key] = latest(find_submissions(folder, owned)[0])
    return found


def _share(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = -1.0
    if not 0 < value <= 1:
        raise argparse.ArgumentTypeError(f"is {text!r}, expected a share above 0, up to 1")
    return value
