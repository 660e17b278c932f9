"""Pictures in the terminal: each character is two pixels, as `raybook --preview` draws them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from rich.segment import Segment, Segments
from rich.style import Style
from rich.text import Text

from ..judge.display import Bytes

UPPER_HALF = "\N{UPPER HALF BLOCK}"


def side_by_side(panes: Sequence[tuple[str, Bytes]], columns: int) -> list[Text | Segments]:
    """The pictures in one row below their names, no wider together than ``columns``."""
    each = max(8, (columns - 2 * (len(panes) - 1)) // len(panes))
    small = [shrunk(pixels, each) for _, pixels in panes]
    names = [f"{name:<{picture.shape[1]}}" for (name, _), picture in zip(panes, small, strict=True)]
    rows: list[Text | Segments] = [Text("  ".join(names))]
    for top in range(0, max(len(p) for p in small), 2):
        segments: list[Segment] = []
        for picture in small:
            segments += [*_row(picture, top), Segment("  ")]
        rows.append(Segments([*segments[:-1], Segment.line()]))
    return rows


def shrunk(pixels: Bytes, columns: int) -> Bytes:
    """The picture at most so wide: means of blocks of pixels."""
    size = max(1, -(-pixels.shape[1] // columns))
    height, width = -(-pixels.shape[0] // size), -(-pixels.shape[1] // size)
    padded = np.pad(
        pixels,
        ((0, height * size - pixels.shape[0]), (0, width * size - pixels.shape[1]), (0, 0)),
        mode="edge",
    )
    blocks = padded.reshape(height, size, width, size, 3).mean(axis=(1, 3))
    return np.asarray(blocks + 0.5, dtype=np.uint8)


def _row(picture: Bytes, top: int) -> list[Segment]:
    if top >= len(picture):
        return [Segment(" " * picture.shape[1])]
    below = picture[min(top + 1, len(picture) - 1)]
    return [
        Segment(UPPER_HALF, Style(color=_rgb(upper), bgcolor=_rgb(lower)))
        for upper, lower in zip(picture[top], below, strict=True)
    ]


def _rgb(colour: Bytes) -> str:
    red, green, blue = (int(c) for c in colour)
    return f"#{red:02x}{green:02x}{blue:02x}"
