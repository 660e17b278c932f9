"""From `assignments/*/assignment.toml` to a `Course`; every fault is one `BadInput`."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Callable
from pathlib import Path

from ..errors import BadInput
from .artefacts import ArtefactCheck, read_artefact
from .model import (
    Assignment,
    BuildCheck,
    Check,
    CostCheck,
    Course,
    ImageCheck,
    Limits,
    ProbeCheck,
    RobustCheck,
    StatisticsCheck,
    UnitCheck,
)
from .pictures import read_pictures, read_resolution
from .table import Table

NAME = "Raybook"

_WithDriver = ProbeCheck | RobustCheck


def load_course(root: Path) -> Course:
    """The course whose checkout is ``root``."""
    files = sorted((root / "assignments").glob("*/assignment.toml"))
    if not files:
        raise BadInput(
            f"{root}: holds no assignments/*/assignment.toml, expected a checkout of the course"
        )
    assignments = sorted((_load(root, file) for file in files), key=lambda a: a.number)
    _refuse_twins(assignments)
    return Course(root, NAME, tuple(assignments))


def _refuse_twins(assignments: list[Assignment]) -> None:
    """No two assignments share a number or an owned file."""
    seen: dict[str, Assignment] = {}
    for assignment in assignments:
        for mark in (f"number {assignment.number}", *assignment.owned):
            if mark in seen:
                raise BadInput(
                    f"{assignment.folder}: {mark} is also in {seen[mark].folder}, "
                    "expected in one assignment only"
                )
            seen[mark] = assignment


def _load(root: Path, file: Path) -> Assignment:
    try:
        table = Table(file, "", tomllib.loads(file.read_text(encoding="utf-8")))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise BadInput(f"{file}: {error}, expected TOML in UTF-8") from error
    number = table.text("number")
    if not re.fullmatch(r"\d\d", number):
        raise table.fault("number", f"is {number!r}", "two digits")
    limits = table.table("limits")
    assignment = Assignment(
        folder=file.parent,
        number=number,
        module=table.text("module"),
        title=table.text("title"),
        points=table.number("points"),
        optional=table.flag("optional"),
        owned=table.texts("owned"),
        todos=table.texts("todos", []),
        limits=Limits(limits.number("wall_seconds", 20), limits.whole("memory_mib", 16, 1024)),
        checks=tuple(
            _check(root, file.parent, check) for check in table.tables("check", "check {}".format)
        ),
        pictures=read_pictures(root, table),
    )
    limits.finish()
    table.finish()
    if assignment.is_graded:
        _verify(root, table, assignment)
    return assignment


def _verify(root: Path, table: Table, assignment: Assignment) -> None:
    total = sum(check.points for check in assignment.checks)
    if abs(total - assignment.points) > 1e-9:
        raise table.fault("points", f"is {assignment.points:g}", f"the checks' sum, {total:g}")
    if not assignment.owned:
        raise table.fault("owned", "is empty", "at least one file of the module")
    for path in assignment.sources:
        table.check_path("owned", path, root)
    names = [check.name for check in assignment.checks]
    for name in names:
        if names.count(name) > 1:
            raise table.fault("check", f"two are called {name!r}", "a name of its own for each")
    kinds = [type(check) for check in assignment.checks]
    if set(kinds) == {ArtefactCheck}:
        _verify_artefacts(table, assignment)
        return
    if ArtefactCheck in kinds or assignment.sources != assignment.owned:
        raise table.fault("check", "of kind 'artefact' and others", "either, not both")
    if kinds.count(BuildCheck) != 1:
        raise table.fault("check", f"{kinds.count(BuildCheck)} of kind 'build'", "exactly one")
    if UnitCheck in kinds and not any(issubclass(kind, ProbeCheck) for kind in kinds):
        raise table.fault("check", "of kind 'unit' alone", "a 'probe' beside it that confirms it")


def _verify_artefacts(table: Table, assignment: Assignment) -> None:
    files = [check.file for check in assignment.checks if isinstance(check, ArtefactCheck)]
    if assignment.sources or set(files) != set(assignment.owned):
        raise table.fault("owned", f"is {list(assignment.owned)}", f"the checks' files, {files}")


def _check(root: Path, folder: Path, table: Table) -> Check:
    kind = table.text("kind")
    if kind not in _KINDS:
        raise table.fault("kind", f"is {kind!r}", f"one of {', '.join(_KINDS)}")
    check = _KINDS[kind](root, folder, table)
    table.finish()
    return check


def _build(root: Path, folder: Path, table: Table) -> Check:
    return BuildCheck(table.text("name"), table.number("points"), table.flag("hidden"))


def _unit(root: Path, folder: Path, table: Table) -> Check:
    return UnitCheck(
        name=table.text("name"),
        points=table.number("points"),
        tests=table.path("tests", folder),
        hidden=table.flag("hidden"),
    )


def _probe(kind: type[_WithDriver]) -> Callable[[Path, Path, Table], Check]:
    """The reader of a kind of check that runs a driver on an oracle's cases."""

    def read(root: Path, folder: Path, table: Table) -> Check:
        return kind(
            name=table.text("name"),
            points=table.number("points"),
            driver=table.path("driver", folder),
            oracle=table.path("oracle", folder),
            group=table.text("group"),
            seed=table.whole("seed", 0),
            hidden=table.flag("hidden"),
        )

    return read


def _cost(root: Path, folder: Path, table: Table) -> Check:
    full, none = table.number("full"), table.number("none")
    if not 1 <= full < none:
        raise table.fault("full", f"is {full:g}, with none = {none:g}", "1 <= full < none")
    probe = _probe(ProbeCheck)(root, folder, table)
    return CostCheck(**vars(probe), full=full, none=none)


def _image(root: Path, folder: Path, table: Table) -> Check:
    return ImageCheck(
        name=table.text("name"),
        points=table.number("points"),
        scene=table.path("scene", root),
        resolution=read_resolution(table),
        spp=table.whole("spp", 1),
        seeds=table.whole("seeds", 2),
        hidden=table.flag("hidden"),
    )


_KINDS: dict[str, Callable[[Path, Path, Table], Check]] = {
    "build": _build,
    "unit": _unit,
    "probe": _probe(ProbeCheck),
    "statistics": _probe(StatisticsCheck),
    "robust": _probe(RobustCheck),
    "cost": _cost,
    "image": _image,
    "artefact": lambda root, folder, table: read_artefact(table),
}
