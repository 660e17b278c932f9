"""Two renderers as processes that take orders, so that they can take turns.

Each is told "SEED SPP THREADS FILE" on a line, and answers with the seconds of processor time and
by the clock that the picture in FILE (raw 32-bit floats) took: bench_image.c, bench_mitsuba.py.
"""

from __future__ import annotations

import os
import subprocess
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType

import numpy as np
import numpy.typing as npt
from bench_machine import pinned
from bench_programs import HERE, ROOT, program

Pixels = npt.NDArray[np.float32]

MITSUBA = HERE.parent / "mitsuba"
MITSUBA_PYTHON = ROOT / "build" / "mitsuba-venv" / "bin" / "python"


class Failed(Exception):
    """A renderer that ended before its time; the text says why."""


@dataclass(frozen=True)
class Shot:
    """A picture (height, width, 3) and what it took."""

    pixels: Pixels
    cpu: float
    wall: float


class Renderer:
    """A process that renders one scene; use it in a `with`."""

    def __init__(self, command: list[str], scratch: Path, resolution: tuple[int, int]) -> None:
        self._command = command
        self._out = scratch / f"{len(list(scratch.iterdir()))}.raw"
        self._out.touch()
        self._resolution = resolution
        self._errors = self._out.with_suffix(".log")

    def __enter__(self) -> Renderer:
        with self._errors.open("w") as log:
            self._process = subprocess.Popen(
                self._command,
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=log,
                text=True,
                env={**os.environ, "PYTHONPATH": str(ROOT / "grader")},
            )
        self._read("ready ")
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        at: TracebackType | None,
    ) -> None:
        self._process.kill()
        self._process.communicate()

    def shoot(self, seed: int, spp: int, threads: int = 1) -> Shot:
        """One picture."""
        assert self._process.stdin is not None
        try:
            self._process.stdin.write(f"{seed} {spp} {threads} {self._out}\n")
            self._process.stdin.flush()
        except BrokenPipeError:
            raise Failed(self._last_words()) from None
        cpu, wall = map(float, self._read("").split())
        width, height = self._resolution
        pixels = np.fromfile(self._out, np.float32).reshape(height, width, 3)
        return Shot(pixels, cpu, wall)

    def _read(self, start: str) -> str:
        """The next line; what others print on standard output is passed over."""
        assert self._process.stdout is not None
        line = self._process.stdout.readline()
        if not line.startswith(start) or not line:
            raise Failed(self._last_words())
        return line

    def _last_words(self) -> str:
        self._process.kill()
        self._process.communicate()
        lines = self._errors.read_text().strip().splitlines()
        return lines[-1] if lines else f"ended with {self._process.returncode}"


def ours(scene: Path, scratch: Path, resolution: tuple[int, int], alone: bool = True) -> Renderer:
    """Our renderer, with the accelerator that it would use."""
    command = [str(program()), "image", str(scene), "wide", "bvh"]
    return Renderer(pinned(command) if alone else command, scratch, resolution)


def mitsuba(
    scene: Path, scratch: Path, resolution: tuple[int, int], variant: str, sampler: str
) -> Renderer:
    """Mitsuba in a variant; `sampler` is its plugin's name, "-": as the scene says."""
    command = [str(MITSUBA_PYTHON), str(HERE / "bench_mitsuba.py"), str(scene), variant, sampler]
    return Renderer(pinned(command), scratch, resolution)


def mitsuba_missing(may_install: bool) -> str:
    """Why there is no Mitsuba; empty: it is there."""
    script = MITSUBA / "environment.sh"
    command = [str(script), *([] if may_install else ["--installed"])]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode == 0:
        return ""
    return (done.stderr.strip().splitlines() or ["Mitsuba could not be installed"])[-1]
