"""The assignments as plain values: what `assignments/*/assignment.toml` holds, validated."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from .artefacts import ArtefactCheck
from .pictures import PublicPicture


@dataclass(frozen=True)
class Limits:
    """What one run of a student's program may use; a run is one probe, test or rendering."""

    wall_seconds: float = 20.0
    memory_mib: int = 1024


@dataclass(frozen=True)
class BuildCheck:
    """The module compiles and links; its points ask for no warning."""

    name: str
    points: float
    hidden: bool = False


@dataclass(frozen=True)
class UnitCheck:
    """The public Unity tests. ``tests`` is relative to the assignment's folder."""

    name: str
    points: float
    tests: str
    hidden: bool = False


@dataclass(frozen=True)
class ProbeCheck:
    """One group of cases: ``driver`` runs in the box, ``oracle`` judges outside of it."""

    name: str
    points: float
    driver: str
    oracle: str
    group: str
    seed: int
    hidden: bool = False


@dataclass(frozen=True)
class StatisticsCheck(ProbeCheck):
    """A probe whose oracle judges by statistics: many random results together, none alone."""


@dataclass(frozen=True)
class RobustCheck:
    """A probe's driver and cases with the module under the sanitizers; no answer is judged.

    The group may hold what the probes leave out, where any answer is right but no crash is.
    """

    name: str
    points: float
    driver: str
    oracle: str
    group: str
    seed: int
    hidden: bool = False


@dataclass(frozen=True)
class CostCheck:
    """How much work one group of cases takes, as a ratio to what the reference needs for it.

    Up to a ratio of ``full`` all points are given, from ``none`` on not one; between the two they
    fall linearly in the logarithm of the ratio. The rest is as in a `ProbeCheck`.
    """

    name: str
    points: float
    driver: str
    oracle: str
    group: str
    seed: int
    full: float
    none: float
    hidden: bool = False


@dataclass(frozen=True)
class ImageCheck:
    """Renderings of a scene, ``seeds`` of them at ``spp`` samples a pixel.

    ``scene`` is relative to the course's root; ``resolution`` is (width, height).
    ``first_seed`` is what calibration moves, to repeat a verdict on other seeds.
    """

    name: str
    points: float
    scene: str
    resolution: tuple[int, int]
    spp: int
    seeds: int
    hidden: bool = False
    first_seed: int = 1


Check = BuildCheck | UnitCheck | ProbeCheck | RobustCheck | CostCheck | ImageCheck | ArtefactCheck


@dataclass(frozen=True)
class Assignment:
    """One assignment. ``owned`` are the only files that are taken from a submission."""

    folder: Path
    number: str
    module: str
    title: str
    points: float
    optional: bool
    owned: tuple[str, ...]
    todos: tuple[str, ...]
    limits: Limits
    checks: tuple[Check, ...]
    pictures: tuple[PublicPicture, ...] = ()

    @property
    def sources(self) -> tuple[str, ...]:
        """The owned files that are compiled; the others are made by tools."""
        return tuple(path for path in self.owned if path.startswith("src/"))

    @property
    def is_graded(self) -> bool:
        """False while no check is declared: such an assignment is left out, with a note."""
        return bool(self.checks)


@dataclass(frozen=True)
class Course:
    """All assignments of one checkout, in the order of their numbers."""

    root: Path
    name: str
    assignments: tuple[Assignment, ...]

    @property
    def sources(self) -> tuple[str, ...]:
        """All files of all assignments that students write."""
        return tuple(path for assignment in self.assignments for path in assignment.sources)

    def assignment(self, number: str) -> Assignment:
        """The assignment of that number; KeyError when there is none."""
        for assignment in self.assignments:
            if assignment.number == number:
                return assignment
        raise KeyError(number)
