"""Checks of files that a student makes with the tools, and does not write: kind `artefact`."""

from __future__ import annotations

from dataclasses import dataclass

from .pictures import read_resolution
from .table import Table

EXPECTS = ("compile-commands", "picture")


@dataclass(frozen=True)
class ArtefactCheck:
    """``file`` is an owned path that must be what ``expects`` says.

    "compile-commands": a compilation database that knows every file that a student writes;
    "picture": an EXR picture of ``resolution`` (width, height) that shows something.
    """

    name: str
    points: float
    file: str
    expects: str
    resolution: tuple[int, int] | None = None
    hidden: bool = False


def read_artefact(table: Table) -> ArtefactCheck:
    """One `[[check]]` table whose kind has been taken."""
    check = ArtefactCheck(
        name=table.text("name"),
        points=table.number("points"),
        file=table.text("file"),
        expects=table.text("expects"),
        hidden=table.flag("hidden"),
    )
    if check.expects not in EXPECTS:
        raise table.fault("expects", f"is {check.expects!r}", f"one of {', '.join(EXPECTS)}")
    if check.expects != "picture":
        return check
    return ArtefactCheck(
        check.name, check.points, check.file, check.expects, read_resolution(table), check.hidden
    )


def read_artefacts(table: Table) -> tuple[ArtefactCheck, ...]:
    """The artefact checks among an assignment's tables; the others are left unread."""
    tables = table.tables("check", "check {}".format)
    return tuple(read_artefact(t) for t in tables if t.text("kind") == "artefact")
