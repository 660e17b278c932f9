"""Findings on the terminal."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence

from rich.console import Console
from rich.text import Text

from .blocks import side_by_side
from .findings import Finding, ShownPicture, State
from .sheet import panes

_MARKS = {
    State.TO_DO: ("\N{WHITE CIRCLE}", "dim"),
    State.FAILING: ("\N{BALLOT X}", "bold red"),
    State.DONE: ("\N{CHECK MARK}", "bold green"),
}
_SHOWN = 6
"""Failures that are told in full; the first mends most of the others."""
_PICTURE_COLUMNS = 120
_UNBROKEN = 10_000


def open_console() -> Console:
    """Standard output; lines are only broken on a terminal."""
    console = Console(highlight=False)
    return console if console.is_terminal else Console(highlight=False, width=_UNBROKEN)


def tell_all(findings: Sequence[Finding], console: Console) -> None:
    """A line or two for each assignment: a list of what is done and what is to do."""
    done = sum(f.state is State.DONE for f in findings)
    console.print(f"{done} of {len(findings)} assignments done\n")
    column = max(len(f.assignment.name) for f in findings)
    for finding in findings:
        optional = " (optional)" if finding.assignment.optional else ""
        style = "dim" if finding.state is State.TO_DO else ""
        name = Text(f"{finding.assignment.name:<{column}}", style)
        lines = _wrapped(finding.headline + optional, column + 4, console)
        console.print(
            Text.assemble(_mark(finding), " ", name, "  ", (lines[0], style)), soft_wrap=True
        )
        for line in [
            *lines[1:],
            *(n for note in _more(finding) for n in _wrapped(note, column + 4, console)),
        ]:
            console.print(Text(" " * (column + 4) + line, "dim"), soft_wrap=True)


def _wrapped(words: str, indent: int, console: Console) -> list[str]:
    """Lines for a terminal; one line where a program may read it."""
    if not console.is_terminal:
        return [words]
    return textwrap.wrap(words, max(30, console.width - indent)) or [""]


def tell_one(finding: Finding, console: Console, pictures_always: bool = False) -> None:
    """All about one assignment, with its pictures where the terminal can show them."""
    name = Text(f" {finding.assignment.name}  ", "bold")
    headline = Text("" if finding.details else finding.headline)
    console.print(Text.assemble(_mark(finding), name, headline))
    for detail in finding.details[:_SHOWN]:
        _print_item(detail, console)
    if len(finding.details) > _SHOWN:
        console.print(f"    and {len(finding.details) - _SHOWN} more")
    if finding.words:
        said = Text(textwrap.indent(finding.words, "    "), "dim")
        console.print("", said, "", sep="\n", soft_wrap=True)
    for note in finding.notes:
        _print_item(f"({note})", console, "dim")
    for shown in finding.pictures:
        _tell_picture(finding, shown, console, pictures_always)


def _tell_picture(finding: Finding, shown: ShownPicture, console: Console, always: bool) -> None:
    judged = shown.judged
    if always or not judged.is_right:
        if console.is_terminal and console.color_system == "truecolor":
            for row in side_by_side(panes(judged), min(console.width - 6, _PICTURE_COLUMNS)):
                console.print("    ", end="")
                console.print(row, end="\n" if isinstance(row, Text) else "")
        kinds = ", ".join(name for name, _ in panes(judged))
        console.print(f"    {shown.sheet}: {kinds}")
    if judged.pixel and judged.yours is not None:
        x, y = judged.pixel
        again = (
            f"make debug A={finding.assignment.number} SCENE={judged.picture.scene} PIXEL={x},{y}"
        )
        console.print(f"    look at one pixel: {again}", soft_wrap=True)


def _print_item(words: str, console: Console, style: str = "") -> None:
    """A sentence, indented, its further lines as well."""
    for line in _wrapped(words, 5, console):
        console.print(Text(f"    {line}", style), soft_wrap=True)


def _mark(finding: Finding) -> Text:
    mark, style = _MARKS[finding.state]
    return Text(mark, style)


def _more(finding: Finding) -> list[str]:
    notes = [f"({note})" for note in finding.notes]
    if finding.state is State.FAILING and (len(finding.details) > 1 or finding.words):
        others = len(finding.details) - 1
        words = f"{others} more; " if others > 0 else ""
        notes.append(f"{words}make check A={finding.assignment.number} tells all")
    return notes
