"""Rendering what a report shows: a scene with options, by the student's own program."""

from __future__ import annotations

import json
import re
import shlex
import tempfile
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from ...checks.words import clean
from ..running import all_threads, run_limited

_SECONDS = 60
"""What one rendering may take: a report should not wait for a tree that is not written yet."""


class NotDrawn(Exception):
    """There is no picture; the text says why, for the report."""


@dataclass(frozen=True)
class Rendering:
    """``png`` is the picture, ``stats`` what `--stats` told."""

    png: bytes
    stats: dict[str, Any]

    @property
    def seconds(self) -> float:
        """Of the rendering alone, without reading files and building the tree."""
        return float(self.stats["render_seconds"])

    @property
    def rays(self) -> int:
        return sum(self.stats["rays"].values())


@dataclass(frozen=True)
class Renderer:
    """The student's program at the top of the project ``root``; the same order is drawn once."""

    program: Path
    root: Path

    def render(self, scene: str, options: str = "") -> Rendering:
        """Raises `NotDrawn`."""
        return _render(self.program, self.root, scene, options)


@cache
def _render(program: Path, root: Path, scene: str, options: str) -> Rendering:
    if not (root / scene).is_file():
        raise NotDrawn(f"there is no file {scene}")
    with tempfile.TemporaryDirectory(prefix="raybook-") as folder:
        exr, png, stats = (Path(folder, f"picture.{end}") for end in ("exr", "png", "json"))
        outputs = ["-q", "-o", str(exr), "--png", str(png), "--stats", str(stats)]
        try:
            command = [str(program), scene, *shlex.split(options), *outputs]
        except ValueError as fault:
            raise NotDrawn(f"the options {options!r} cannot be read: {fault}") from None
        done = run_limited(command, root, _SECONDS, all_threads())
        if done.code is None:
            raise NotDrawn(f"{scene} was not drawn within {_SECONDS} seconds")
        if done.code != 0:
            said = clean(done.err, 3)
            raise NotDrawn(f"{scene} cannot be drawn: {said or f'exit code {done.code}'}")
        return Rendering(png.read_bytes(), json.loads(stats.read_text(encoding="utf-8")))


def numbers_of(rendering: Rendering) -> str:
    """How much work a picture was, in a few words."""
    stats = rendering.stats
    rate = float(stats["samples_per_second"]) / 1e6
    return (
        f"{stats['samples']:,} samples in {rendering.seconds:.2f} s on {stats['threads']} "
        f"thread{'s' * (stats['threads'] != 1)}, {rate:.2f} million a second"
    )


def split_order(line: str) -> tuple[str, str]:
    """A scene and its options from one line of a report."""
    scene, _, options = line.strip().partition(" ")
    return scene, re.sub(r"\s+", " ", options.strip())
