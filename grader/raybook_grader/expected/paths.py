"""The paths of some pixels of a public picture, as `raybook --pixel` tells them."""

from __future__ import annotations

import tempfile
from pathlib import Path

from ..course.pictures import PublicPicture
from ..files import write_bytes
from ..student.path_log import log_options
from ..student.shipped import Pixel, pack_paths
from .statistics import kept, run_reference

_STEP = 8
"""Pixels between two whose paths are shipped, across and down."""


def expected_paths_file(root: Path, program: Path, picture: PublicPicture) -> Path:
    """The paths of a grid of pixels, packed; made if they are not there."""
    file = kept(root, program, picture, "paths", _STEP).with_suffix(".paths.gz")
    if not file.is_file():
        grid = {pixel: expected_path(root, program, picture, pixel) for pixel in grid_of(picture)}
        write_bytes(file, pack_paths(grid))
    return file


def expected_path(root: Path, program: Path, picture: PublicPicture, pixel: Pixel) -> str:
    """The paths of one pixel."""
    with tempfile.TemporaryDirectory(prefix="raybook-") as folder:
        options = log_options(pixel, Path(folder, "pixel.exr"))
        command = [str(program), picture.scene, *picture.settings, *options]
        return run_reference(command, root)


def grid_of(picture: PublicPicture) -> list[Pixel]:
    """The pixels in the middle of squares of `_STEP`."""
    width, height = picture.resolution
    first = _STEP // 2
    return [(x, y) for y in range(first, height, _STEP) for x in range(first, width, _STEP)]
