"""The PNG of a judged picture: yours, the expected one and the difference, side by side."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from PIL import Image as Picture

from ..judge.display import Bytes, coloured, tone_mapped
from ..judge.pixels import Image, luminance
from ..judge.viewing import viewing_of
from .pictures import JudgedPicture
from .project import Assignment

_GAP = 8
_LEAST = 256
"""Width of one picture on the sheet: small ones are enlarged, each pixel a square."""


def panes(judged: JudgedPicture) -> list[tuple[str, Bytes]]:
    """The pictures of a sheet with their names, in sRGB: what there is of yours, expected and
    difference."""
    white = viewing_of(judged.expected).white
    expected = ("expected", tone_mapped(judged.expected, white))
    yours = judged.yours
    if yours is None:
        return [expected]
    shown = [("yours", tone_mapped(yours, white)), expected]
    if yours.shape == judged.expected.shape:
        shown.append(("difference", _difference(yours, judged.expected, white)))
    return shown


def write_sheet(root: Path, assignment: Assignment, judged: JudgedPicture) -> Path:
    """Write it to `build/check/`; its path, relative to the root."""
    file = Path("build/check", f"{Path(assignment.folder).name}-{judged.picture.name}.png")
    (root / file).parent.mkdir(parents=True, exist_ok=True)
    pictures = [_enlarged(pixels) for _, pixels in panes(judged)]
    height = max(len(p) for p in pictures)
    gap = np.full((height, _GAP, 3), 255, np.uint8)
    row: list[Bytes] = []
    for picture in pictures:
        below = np.full((height - len(picture), picture.shape[1], 3), 255, np.uint8)
        row += [np.concatenate([picture, below]), gap]
    Picture.fromarray(np.concatenate(row[:-1], axis=1), "RGB").save(root / file)
    return file


def _difference(yours: Image, expected: Image, white: float) -> Bytes:
    """Black where they agree, the brighter the more they differ."""
    finite = np.nan_to_num(yours, nan=0.0, posinf=white, neginf=0.0)
    return coloured(np.abs(luminance(finite) - luminance(expected)), 0.0, white / 4)


def _enlarged(pixels: Bytes) -> Bytes:
    times = max(1, -(-_LEAST // pixels.shape[1]))
    return np.repeat(np.repeat(pixels, times, axis=0), times, axis=1)
