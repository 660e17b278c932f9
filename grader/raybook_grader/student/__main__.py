"""`python -m raybook_grader.student`: what `make check`, `watch`, `hint` and `debug` call.

Exit codes: 0 nothing that was begun fails; 1 something does (with --strict also what is not
begun); 2 bad usage.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from rich.text import Text

from ..errors import BadInput
from ..handed_out import MARKER_FILE
from .check import Checker
from .debug import debug
from .findings import Finding, State
from .hints import hint_again, next_hint, overview
from .make import DoesNotBuild, Maker
from .project import Expected, Project, read_assignments
from .shipped import Shipped
from .tell import open_console, tell_all, tell_one
from .watch import watch


def open_project(root: Path) -> Project:
    """The project at ``root``: a student edition, or the course's own checkout."""
    return Project(root, read_assignments(root), _expected(root))


def _expected(root: Path) -> Expected:
    if (root / MARKER_FILE).is_file() or not (root / "grader").is_dir():
        return Shipped(root)
    from ..expected.live import Live  # not part of the student edition

    return Live.of_environment(root)


def main() -> int:
    arguments = _parser().parse_args()
    try:
        return int(arguments.handler(arguments))
    except BadInput as fault:
        print(f"raybook: {fault}", file=sys.stderr)
        return 2
    except DoesNotBuild as words:
        print(f"raybook: the renderer does not build:\n{words}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return 130


def run_check(arguments: argparse.Namespace) -> int:
    """All assignments in a line each, or those that were named in full."""
    project = open_project(arguments.root)
    console = open_console()
    findings = Checker.of(project).check(project.chosen(arguments.assignment))
    if arguments.assignment:
        for finding in findings:
            tell_one(finding, console, pictures_always=True)
    else:
        tell_all(findings, console)
    return _exit_code(findings, arguments.strict)


def _exit_code(findings: list[Finding], strict: bool) -> int:
    bad = {State.FAILING, State.TO_DO} if strict else {State.FAILING}
    return 1 if any(finding.state in bad for finding in findings) else 0


def run_watch(arguments: argparse.Namespace) -> int:
    """Check on every save, until interrupted."""
    console = open_console()
    root = arguments.root

    def look() -> None:
        console.clear()
        try:
            project = open_project(root)
            for finding in Checker.of(project).check(project.chosen(arguments.assignment)):
                tell_one(finding, console, pictures_always=True)
        except BadInput as fault:  # a file that is half written
            console.print(str(fault))
        console.print("\nwaiting for the next save; Ctrl-C ends", style="dim")

    if not arguments.assignment:
        raise BadInput("say which assignment: make watch A=03")
    open_project(root).chosen(arguments.assignment)
    watch(root, look, arguments.rounds)
    return 0


def run_hint(arguments: argparse.Namespace) -> int:
    """The next hint, one of the earlier ones, or how many there are."""
    project = open_project(arguments.root)
    if not arguments.assignment:
        print("\n".join([*overview(project), "make hint A=03 shows the next one"]))
        return 0
    for assignment in project.chosen(arguments.assignment):
        if arguments.again:
            number, text = arguments.again, hint_again(project, assignment, arguments.again)
        else:
            number, text = next_hint(project, assignment)
        print(f"hint {number} for assignment {assignment.number}\n\n{text}")
    return 0


def run_debug(arguments: argparse.Namespace) -> int:
    """One pixel's paths and the first step that differs."""
    if not arguments.pixel:
        raise BadInput("say which pixel: make debug A=03 PIXEL=32,20")
    project = open_project(arguments.root)
    found = debug(project, arguments.assignment, arguments.scene, arguments.pixel)
    console = open_console()
    x, y = found.pixel
    width, height = found.picture.resolution
    console.print(f"{found.picture.scene}, {width} x {height}, pixel {x},{y}", style="bold")
    if arguments.pixel.replace(" ", "") != f"{x},{y}":
        console.print(f"(the nearest to {arguments.pixel} whose right paths are known here)")
    console.print(Text(found.log))
    if found.expected is None:
        console.print("What is right for this scene is not known here: make debug A=NN compares.")
        return 0
    if found.difference is None:
        console.print("All steps are as expected.", style="green")
        return 0
    d = found.difference
    console.print(f"The first step that differs (sample {d.sample}): {d.about}.", style="bold red")
    console.print(Text(f"  yours:    {d.yours.strip() or 'nothing: the path has ended'}"))
    console.print(Text(f"  expected: {d.expected.strip() or 'nothing: the path has ended'}"))
    console.print(
        "Where your use of random numbers is another one, a random step may differ and be right.",
        style="dim",
    )
    return 0


def run_report(arguments: argparse.Namespace) -> int:
    """report.md as HTML and PDF, with pictures and timings of the student's own build."""
    from .report.write import write_report  # its libraries are slow to load

    project = open_project(arguments.root)
    program = Maker(project.root).release()
    written, reason = write_report(
        project.root, program, lambda: Checker.of(project).check(project.assignments)
    )
    for file in written:
        print(file)
    if reason:
        print(reason, file=sys.stderr)
    return 1 if reason else 0


def _parser() -> argparse.ArgumentParser:
    top = argparse.ArgumentParser(prog="raybook", description="The student's tools.")
    top.add_argument("--root", type=Path, default=Path.cwd(), help="the project's folder")
    commands = top.add_subparsers(metavar="COMMAND", required=True)
    check = _command(commands, "check", run_check)
    check.add_argument("--strict", action="store_true", help="what is not begun fails, too")
    watched = _command(commands, "watch", run_watch)
    watched.add_argument("--rounds", type=int, default=0, help="end after so many checks")
    hint = _command(commands, "hint", run_hint)
    hint.add_argument("--again", type=int, default=0, metavar="N", help="a hint taken before")
    debugged = _command(commands, "debug", run_debug)
    debugged.add_argument("--scene", default="")
    debugged.add_argument("--pixel", default="", metavar="X,Y")
    _command(commands, "report", run_report)
    return top


def _command(
    commands: argparse._SubParsersAction[argparse.ArgumentParser],
    name: str,
    handler: object,
) -> argparse.ArgumentParser:
    parser = commands.add_parser(name, description=getattr(handler, "__doc__", None))
    parser.add_argument("--assignment", default="", metavar="A", help="numbers, like 01,03")
    parser.set_defaults(handler=handler)
    return parser


if __name__ == "__main__":
    sys.exit(main())
