"""Rendering a scene in the box, one seed a run."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from ..course import ImageCheck
from .scene import BOX_ROOT

PICTURE = "out.exr"


@dataclass(frozen=True)
class Picture:
    """What is rendered: ``spp`` samples a pixel for each seed."""

    scene: str
    resolution: tuple[int, int]
    spp: int

    @property
    def pixels(self) -> int:
        return self.resolution[0] * self.resolution[1]

    def arguments(self, seed: int, threads: int = 1, scene: Path | None = None) -> Sequence[str]:
        """The renderer's command line, for a box that holds the scene's files if none is given."""
        width, height = self.resolution
        return [
            "--quiet", "--seed", str(seed), "--spp", str(self.spp), "--threads", str(threads),
            "--resolution", f"{width}x{height}", "--output", PICTURE,
            str(scene or f"{BOX_ROOT}/{self.scene}"),
        ]  # fmt: skip


def picture_of(check: ImageCheck) -> Picture:
    """What a student's renderer is asked for."""
    return Picture(check.scene, check.resolution, check.spp)
