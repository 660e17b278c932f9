"""One student's module under test: built once, run many times."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from ..course import Assignment
from ..sandbox import BoxResult, Limits
from .program import ModuleObjects, Workshop
from .trouble import Trouble, trouble

# Processor time is what a module spends, whatever else the machine does; real time only stops
# programs that wait for ever.
_PATIENCE = 2.0


class Stopped(Exception):
    """A run of the student's program that gave no answer; ``said`` is what it printed."""

    def __init__(self, problem: Trouble, said: bytes = b"") -> None:
        super().__init__(problem.message)
        self.problem = problem
        self.said = said


@dataclass(frozen=True)
class Subject:
    """A module that compiled and linked. ``renderer`` is the renderer with it.

    Other programs with it are linked when first asked for, and kept: several checks share a driver.
    """

    workshop: Workshop
    assignment: Assignment
    module: ModuleObjects
    renderer: bytes
    _programs: dict[tuple[str, Path], bytes] = field(
        default_factory=dict, init=False, repr=False, compare=False
    )

    @property
    def limits(self) -> Limits:
        """What the assignment allows one run."""
        limits = self.assignment.limits
        return Limits(
            wall_seconds=_PATIENCE * limits.wall_seconds,
            cpu_seconds=limits.wall_seconds,
            memory_bytes=limits.memory_mib << 20,
        )

    def driver(self, source: Path) -> bytes:
        """`Workshop.driver` with this module."""
        return self._once("driver", self.workshop.driver, source)

    def sanitized_driver(self, source: Path) -> bytes:
        """`Workshop.sanitized_driver` with this module."""
        return self._once("sanitized driver", self.workshop.sanitized_driver, source)

    def _once(self, kind: str, link: Callable[[ModuleObjects, Path], bytes], source: Path) -> bytes:
        if (kind, source) not in self._programs:
            self._programs[kind, source] = link(self.module, source)
        return self._programs[kind, source]

    def run(
        self,
        program: bytes,
        arguments: Sequence[str],
        *,
        inputs: Mapping[str, bytes] | None = None,
        binds: Mapping[str, Path] | None = None,
        collect: Sequence[str] = (),
        limits: Limits | None = None,
        env: Mapping[str, str] | None = None,
    ) -> BoxResult:
        """Run a program that holds the student's code, in a fresh box, within `self.limits`.

        The result is an answer, if not a right one; raises `Stopped` if there is none.
        """
        limits = limits or self.limits
        result = self.workshop.box.run(
            ["/program", *arguments],
            binds=binds or {},
            inputs={"/program": program, **(inputs or {})},
            collect=collect,
            limits=limits,
            env=env,
        )
        if problem := trouble(result, limits.memory_bytes):
            raise Stopped(problem, result.stdout + result.stderr)
        return result
