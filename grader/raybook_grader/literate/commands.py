"""The literate commands: of raybook-grader (`add_commands`) and of `python -m ...literate`.

Each handler takes the parsed arguments and returns the exit code: 0 all is well, 1 violations or
leaks, 2 bad usage. A command's handler is the `handler` of its parsed arguments.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import TYPE_CHECKING, TextIO

from ..errors import BadInput
from ..expected.ship import expected_files
from .check import check, load_assignments
from .export import export
from .handout import HandoutError, LeakError, write_handout
from .leaks import scan
from .secrets import checkout_secrets
from .tree import UnsoundSourceError, load_tree

if TYPE_CHECKING:
    # argparse has no public name for what add_subparsers() returns.
    Subparsers = argparse._SubParsersAction[argparse.ArgumentParser]

Handler = Callable[[argparse.Namespace], int]


def add_commands(subparsers: Subparsers) -> None:
    """Register `literate-check`, `literate-leaks` and `handout` with raybook-grader."""
    _add_check(subparsers, "literate-check")
    _add_leaks(subparsers, "literate-leaks")
    _add_handout(subparsers)


def add_short_commands(subparsers: Subparsers) -> None:
    """Register `check`, `todos`, `student`, `leaks` and `handout`, for this package alone."""
    _add_check(subparsers, "check")
    _add(subparsers, "todos", run_todos, "list the exercises, where they stand and whose they are")
    student = _add(subparsers, "student", run_student, "print the student's text of a file")
    student.add_argument("file", help="a file of the source, such as src/shapes/triangle.c")
    _add_leaks(subparsers, "leaks")
    _add_handout(subparsers)


def run_check(arguments: argparse.Namespace) -> int:
    """Print every violation of the checkout."""
    violations = check(arguments.root)
    for violation in violations:
        print(violation)
    if violations:
        return 1
    tree = load_tree(arguments.root)
    fragments, todos = len(tree.fragments), len(tree.todos)
    print(f"{len(tree.files)} files, {fragments} fragments, {todos} exercises: no violation")
    return 0


def run_todos(arguments: argparse.Namespace) -> int:
    """Print one line for each exercise: name, place, assignment."""
    assignments, _ = load_assignments(arguments.root)
    owner = {name: a.number for a in assignments for name in a.todos}
    for todo in load_tree(arguments.root).todos.values():
        print(f"{todo.name}  {todo.file}:{todo.line}  {owner.get(todo.name, '-')}")
    return 0


def run_student(arguments: argparse.Namespace) -> int:
    """Print the student's text of one file."""
    tree = load_tree(arguments.root)
    if arguments.file not in tree.files:
        return _bad_usage(f"{arguments.file}: no such file of the source in {arguments.root}")
    print(export(tree.files[arguments.file]).text, end="")
    return 0


def run_leaks(arguments: argparse.Namespace) -> int:
    """Print every place in the artefacts where a secret can be read."""
    secrets = checkout_secrets(arguments.root, arguments.reveal)
    clean = True
    for artefact in arguments.artefacts:
        report = scan(artefact, secrets)
        _print_lines(report.leaks, sys.stdout)
        _print_lines([f"NOT SEARCHED {name}" for name in report.unread], sys.stdout)
        found = f"{len(report.leaks)} leaks of {len(secrets.lines)} secret lines"
        print(f"{artefact}: {report.documents} files, {found}")
        clean = clean and report.clean
    return 0 if clean else 1


def run_handout(arguments: argparse.Namespace) -> int:
    """Write the student edition."""
    report = write_handout(
        arguments.root,
        arguments.out,
        arguments.assignment,
        arguments.reveal,
        lambda selection: expected_files(arguments.root, selection),
    )
    for name in report.left_out:
        print(f"warning: {name} is not in git, so it is not handed out", file=sys.stderr)
    print(f"{report.out}: {report.files} files, no leak")
    return 0


def guarded(handler: Handler) -> Handler:
    """The handler with its errors turned into a message and an exit code."""

    def run(arguments: argparse.Namespace) -> int:
        try:
            return handler(arguments)
        except UnsoundSourceError as fault:
            _print_lines(fault.violations, sys.stderr)
            return 1
        except LeakError as fault:
            print(f"{fault}\nnothing written: the edition would leak", file=sys.stderr)
            return 1
        except (HandoutError, BadInput, FileNotFoundError, ValueError) as fault:
            return _bad_usage(str(fault))

    return run


def _add_check(subparsers: Subparsers, name: str) -> None:
    _add(subparsers, name, run_check, "check the markers of the source and its exercises")


def _add_leaks(subparsers: Subparsers, name: str) -> None:
    leaks = _add(subparsers, name, run_leaks, "search what students get for solutions")
    leaks.add_argument("artefacts", type=Path, nargs="+", metavar="PATH", help="file or folder")
    _add_reveal(leaks, "assignments whose solutions are no secret")


def _add_handout(subparsers: Subparsers) -> None:
    handout = _add(subparsers, "handout", run_handout, "write the student edition")
    handout.add_argument("out", type=Path, metavar="OUT", help="the folder to write")
    handout.add_argument(
        "--assignment", metavar="N", help="hand out the assignments up to this one (default: all)"
    )
    _add_reveal(handout, "assignments whose solutions stay in")


def _add(
    subparsers: Subparsers, name: str, handler: Handler, summary: str
) -> argparse.ArgumentParser:
    parser = subparsers.add_parser(name, help=summary, description=summary)
    parser.add_argument("--root", type=Path, default=default_root(), help="the checkout")
    parser.set_defaults(handler=guarded(handler))
    return parser


def _add_reveal(parser: argparse.ArgumentParser, summary: str) -> None:
    parser.add_argument(
        "--reveal", type=_numbers, default=(), metavar="LIST", help=f"{summary}, such as 01,02"
    )


def default_root() -> Path:
    """The checkout that this package is installed from."""
    return Path(__file__).resolve().parents[3]


def _numbers(text: str) -> tuple[str, ...]:
    return tuple(number.strip() for number in text.split(",") if number.strip())


def _print_lines(lines: Iterable[object], stream: TextIO) -> None:
    for line in lines:
        print(line, file=stream)


def _bad_usage(message: str) -> int:
    print(f"error: {message}", file=sys.stderr)
    return 2
