"""What was shipped with the student edition: expected pictures and paths, digests of the stubs."""

from __future__ import annotations

import gzip
import json
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from ..course.pictures import PublicPicture
from ..handed_out import HandedOut, read_handed_out
from ..judge.reference import ReferenceStatistics
from .project import Assignment, PathLog

Pixel = tuple[int, int]

FOLDER = "expected"
"""In an assignment's folder; made by `make handout`."""


def statistics_name(picture: PublicPicture, undone: tuple[str, ...]) -> str:
    """The file of what a picture looks like while some assignments are stubs."""
    return f"{FOLDER}/{picture.name}{_without(undone)}.npz"


def paths_name(picture: PublicPicture, undone: tuple[str, ...]) -> str:
    """The file of the paths of some of its pixels."""
    return f"{FOLDER}/{picture.name}{_without(undone)}.paths.gz"


def pack_paths(paths: dict[Pixel, str]) -> bytes:
    """The content of such a file; the same bytes for the same paths."""
    values = {f"{x},{y}": text for (x, y), text in sorted(paths.items())}
    return gzip.compress(json.dumps(values, indent=0).encode(), mtime=0)


def unpack_paths(content: bytes) -> dict[Pixel, str]:
    """The inverse."""
    values: dict[str, str] = json.loads(gzip.decompress(content))
    return {_pixel(key): text for key, text in values.items()}


def nearest(pixels: list[Pixel], wanted: Pixel) -> Pixel:
    """The pixel next to the one that is wanted."""
    return min(pixels, key=lambda p: (p[0] - wanted[0]) ** 2 + (p[1] - wanted[1]) ** 2)


@dataclass(frozen=True)
class Shipped:
    """`Expected` for the student edition at ``root``."""

    root: Path

    @cached_property
    def handed_out(self) -> HandedOut:
        return read_handed_out(self.root)

    def source(self, path: str) -> Path:
        return self.root / path

    def is_begun(self, number: str) -> bool:
        return self.handed_out.is_begun(number, self.root)

    def is_solution(self, number: str) -> bool:
        return number in self.handed_out.solutions

    def statistics(
        self, assignment: Assignment, picture: PublicPicture, undone: tuple[str, ...]
    ) -> ReferenceStatistics | None:
        file = self.root / assignment.folder / statistics_name(picture, undone)
        return ReferenceStatistics.load(file) if file.is_file() else None

    def path_log(
        self,
        assignment: Assignment | None,
        picture: PublicPicture,
        undone: tuple[str, ...],
        pixel: Pixel,
    ) -> PathLog | None:
        if assignment is None:
            return None
        file = self.root / assignment.folder / paths_name(picture, undone)
        if not file.is_file():
            return None
        paths = unpack_paths(file.read_bytes())
        found = nearest(list(paths), pixel)
        return PathLog(found, paths[found])


def _without(undone: tuple[str, ...]) -> str:
    return f"-without-{'-'.join(undone)}" if undone else ""


def _pixel(text: str) -> Pixel:
    x, y = text.split(",")
    return int(x), int(y)
