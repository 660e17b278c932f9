"""`Expected` in the course's own checkout: what is checked is `src/`, with VARIANT and TODO as in
every other build; what is expected is rendered by the reference."""

from __future__ import annotations

import os
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from ..checks.stub import is_stub, stub_text
from ..course.pictures import PublicPicture
from ..judge.reference import ReferenceStatistics
from ..literate.check import Assignment as Exercises
from ..literate.check import load_assignments
from ..student.project import Assignment, PathLog
from .paths import expected_path
from .programs import reference_program
from .statistics import expected_statistics


@dataclass(frozen=True)
class Live:
    """The checkout at ``root``; ``variant`` and ``todo`` are the build's."""

    root: Path
    variant: str = ""
    todo: tuple[str, ...] = ()

    @classmethod
    def of_environment(cls, root: Path) -> Live:
        """As `make` was told."""
        return cls(root, os.environ.get("VARIANT", ""), tuple(os.environ.get("TODO", "").split()))

    def source(self, path: str) -> Path:
        other = self.root / self.variant / path
        return other if self.variant and other.is_file() else self.root / path

    def is_begun(self, number: str) -> bool:
        exercises = self._exercises.get(number)
        if exercises is None:
            return True
        owned = [path for path in exercises.owned if path.startswith("src/")]
        others = [path for path in owned if self.source(path) != self.root / path]
        if others:
            return not all(
                is_stub(self.source(path).read_bytes(), stub_text(self.root, path))
                for path in others
            )
        if not owned:
            return all((self.root / path).is_file() for path in exercises.owned)
        return not exercises.todos or not set(exercises.todos) <= set(self.todo)

    def is_solution(self, number: str) -> bool:
        return False

    def statistics(
        self, assignment: Assignment, picture: PublicPicture, undone: tuple[str, ...]
    ) -> ReferenceStatistics | None:
        program = reference_program(self.root, self.stubs(undone))
        return expected_statistics(self.root, program, picture)

    def path_log(
        self,
        assignment: Assignment | None,
        picture: PublicPicture,
        undone: tuple[str, ...],
        pixel: tuple[int, int],
    ) -> PathLog | None:
        program = reference_program(self.root, self.stubs(undone))
        return PathLog(pixel, expected_path(self.root, program, picture, pixel))

    def stubs(self, undone: tuple[str, ...]) -> frozenset[str]:
        """The exercises of these assignments."""
        return frozenset(name for n in undone for name in self._exercises[n].todos)

    @cached_property
    def _exercises(self) -> dict[str, Exercises]:
        return {found.number: found for found in load_assignments(self.root)[0]}
