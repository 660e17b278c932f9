"""What an OpenEXR file must be to be judged: the rules, in words, for whoever decodes it.

Everything that is not one plain scan-line part with full-size R, G and B is refused; its size is
limited before a pixel is decoded.
"""

from __future__ import annotations

import struct
from collections.abc import Iterable
from typing import Protocol

from ..errors import BadInput

MAX_PIXELS = 1 << 24  # 4096 x 4096: twice a 4K frame
MAX_SAMPLES = 1 << 26  # pixels times channels: 256 MiB decoded

DAMAGED_HEADER = "its header is damaged or cut short"
DAMAGED_PIXELS = "it is truncated or damaged"

_MAGIC = 20000630  # OpenEXR file layout, "Magic number" and "Version field"
_REFUSED_FLAGS = (
    (0x200, "it is tiled; write scan lines"),
    (0x800, "it holds deep data; write flat pixels"),
    (0x1000, "it has several parts; write one"),
)

Window = tuple[int, int, int, int]
"""x0, y0, x1, y1, both corners inside."""


class UnusableImage(BadInput):
    """A file or buffer is no picture that can be judged; the text says why."""


class Channel(Protocol):
    """A channel as a header lists it."""

    @property
    def name(self) -> str: ...
    @property
    def xSampling(self) -> int: ...
    @property
    def ySampling(self) -> int: ...


def check_version(data: bytes) -> None:
    """The file's first eight bytes."""
    if not data:
        raise UnusableImage("it is empty, not an OpenEXR picture")
    if len(data) < 8 or struct.unpack_from("<i", data)[0] != _MAGIC:
        raise UnusableImage("it is not an OpenEXR picture")
    flags = struct.unpack_from("<I", data, 4)[0]
    for flag, reason in _REFUSED_FLAGS:
        if flags & flag:
            raise UnusableImage(reason)


def checked_size(window: Window, display: Window, max_pixels: int) -> tuple[int, int]:
    """Width and height of the data window."""
    width, height = window[2] - window[0] + 1, window[3] - window[1] + 1
    if width < 1 or height < 1:
        raise UnusableImage(f"its data window {window} is empty")
    if width * height > max_pixels:
        raise UnusableImage(
            f"its data window claims {width} x {height} pixels; at most {max_pixels} are read"
        )
    if window != display:
        raise UnusableImage(f"its data window {window} is not its display window {display}")
    return width, height


def check_channels(channels: Iterable[Channel], pixels: int) -> None:
    """R, G and B are there, and all channels are of full size."""
    by_name = {channel.name: channel for channel in channels}
    missing = [name for name in "RGB" if name not in by_name]
    if missing:
        found = ", ".join(sorted(by_name)[:8]) or "none"
        raise UnusableImage(f"it has no channel {', '.join(missing)} (found: {found})")
    if len(by_name) * pixels > MAX_SAMPLES:
        raise UnusableImage(f"it has {len(by_name)} channels: too many for its size")
    for channel in by_name.values():
        if (channel.xSampling, channel.ySampling) != (1, 1):
            raise UnusableImage(f"its channel {channel.name!r} is subsampled")


def with_complaint(reason: str, complaint: str) -> str:
    """The reason with the first line of what the decoding library said."""
    lines = complaint.splitlines()
    printable = "".join(c for c in lines[0] if c.isprintable())[:160] if lines else ""
    return f"{reason} ({printable})" if printable else reason
