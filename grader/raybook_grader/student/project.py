"""The folder that a student works in: its assignments, and what the course says of them."""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from ..course.artefacts import ArtefactCheck, read_artefacts
from ..course.pictures import PublicPicture, read_pictures
from ..course.table import Table
from ..errors import BadInput
from ..judge.reference import ReferenceStatistics


@dataclass(frozen=True)
class Assignment:
    """What a student may know of an assignment. ``folder`` is relative to the project's root."""

    folder: str
    number: str
    module: str
    points: float
    optional: bool
    owned: tuple[str, ...]
    wall_seconds: float
    tests: tuple[str, ...]
    pictures: tuple[PublicPicture, ...]
    artefacts: tuple[ArtefactCheck, ...]

    @property
    def name(self) -> str:
        return f"{self.number} {self.module}"

    @property
    def sources(self) -> tuple[str, ...]:
        """The owned files that are compiled."""
        return tuple(path for path in self.owned if path.endswith(".c"))


@dataclass(frozen=True)
class PathLog:
    """What `raybook --pixel` says where all is right, for ``pixel`` (x, y)."""

    pixel: tuple[int, int]
    text: str


class Expected(Protocol):
    """What the course knows and a student needs: from files, or from the reference."""

    def source(self, path: str) -> Path:
        """Where the student's text of an owned file is."""

    def is_begun(self, number: str) -> bool:
        """Whether the assignment's files are more than the stubs that were handed out.

        True for an assignment that nobody knows of.
        """

    def is_solution(self, number: str) -> bool:
        """Whether the solution was handed out."""

    def statistics(
        self, assignment: Assignment, picture: PublicPicture, undone: tuple[str, ...]
    ) -> ReferenceStatistics | None:
        """What the picture looks like while the assignments ``undone`` are stubs."""

    def path_log(
        self,
        assignment: Assignment | None,
        picture: PublicPicture,
        undone: tuple[str, ...],
        pixel: tuple[int, int],
    ) -> PathLog | None:
        """The paths of the pixel, or of the nearest one whose paths are known.

        ``assignment`` is None for a scene that is no public picture.
        """


@dataclass(frozen=True)
class Project:
    """The folder at ``root``."""

    root: Path
    assignments: tuple[Assignment, ...]
    expected: Expected

    def chosen(self, numbers: str) -> list[Assignment]:
        """The assignments of a list such as "03" or "1,2"; all for ""."""
        known = {assignment.number: assignment for assignment in self.assignments}
        wanted = [n.strip().zfill(2) for n in numbers.split(",") if n.strip()]
        for number in wanted:
            if number not in known:
                raise BadInput(
                    f"A={number}: no such assignment, expected one of {', '.join(known)}"
                )
        return [known[number] for number in wanted or known]

    def undone(self, picture: PublicPicture) -> tuple[str, ...]:
        """The assignments that the picture varies with and that are not begun."""
        return tuple(n for n in picture.varies_with if not self.expected.is_begun(n))


def read_assignments(root: Path) -> tuple[Assignment, ...]:
    """The assignments of a project, in the order of their numbers."""
    files = sorted(root.glob("assignments/*/assignment.toml"))
    if not files:
        raise BadInput(f"{root}: holds no assignments/*/assignment.toml, expected Raybook's folder")
    return tuple(_read(root, file) for file in files)


def _read(root: Path, file: Path) -> Assignment:
    try:
        table = Table(file, "", tomllib.loads(file.read_text(encoding="utf-8")))
    except ValueError as error:
        raise BadInput(f"{file}: {error}, expected TOML in UTF-8") from error
    folder = file.parent
    return Assignment(
        folder=folder.relative_to(root).as_posix(),
        number=table.text("number"),
        module=table.text("module"),
        points=table.number("points"),
        optional=table.flag("optional"),
        owned=table.texts("owned"),
        wall_seconds=table.table("limits").number("wall_seconds", 20),
        tests=tuple(t.relative_to(root).as_posix() for t in sorted(folder.glob("test_*.c"))),
        pictures=read_pictures(root, table),
        artefacts=read_artefacts(table),
    )
