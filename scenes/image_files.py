"""Writes images: Radiance HDR for light, PNG for colours of surfaces. Standard library only."""

from __future__ import annotations

import math
import struct
import zlib
from collections.abc import Iterable, Iterator, Sequence

Color = tuple[float, float, float]
Rows = Sequence[Sequence[Color]]
"""Linear RGB, Rec. 709 primaries; the first row is the top one. All rows are of one length."""


def srgb_code(x: float) -> int:
    """The 8-bit code of a linear value (IEC 61966-2-1); outside of 0 .. 1 it is clipped."""
    x = min(max(x, 0.0), 1.0)
    curve = 12.92 * x if x <= 0.0031308 else 1.055 * x ** (1 / 2.4) - 0.055
    return int(255.0 * curve + 0.5)


CODES = [srgb_code(i / 4095) for i in range(4096)]
"""srgb_code of a fine grid: pixels need not take a power each."""


def png_chunk(kind: bytes, data: bytes) -> bytes:
    """Length, kind, data and check sum."""
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def png(rows: Rows) -> Iterator[bytes]:
    """An 8-bit sRGB PNG file (W3C, "Portable Network Graphics", 3rd edition)."""
    header = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 2, 0, 0, 0)
    lines = bytearray()
    for pixels in rows:
        lines.append(0)  # this row is not predicted from another
        lines += bytes(CODES[int(4095.0 * min(max(c, 0.0), 1.0) + 0.5)] for p in pixels for c in p)
    yield b"\x89PNG\r\n\x1a\n" + png_chunk(b"IHDR", header) + png_chunk(b"sRGB", b"\0")
    yield png_chunk(b"IDAT", zlib.compress(bytes(lines), 6)) + png_chunk(b"IEND", b"")


def rgbe(color: Color) -> tuple[int, int, int, int]:
    """Three mantissas and a common exponent (G. Ward, "Real Pixels", Graphics Gems II, 1991)."""
    largest = max(color)
    if largest < 1e-32:
        return 0, 0, 0, 0
    exponent = math.frexp(largest)[1]
    factor = math.ldexp(256.0, -exponent)
    r, g, b = color
    red, green, blue = (min(int(c * factor + 0.5), 255) for c in (r, g, b))
    return red, green, blue, exponent + 128


def component_bytes(values: Sequence[int]) -> bytes:
    """One component of a row: pieces of at most 128 bytes, each behind its length.

    The format could say repeated bytes in two; images of light have few of them.
    """
    starts = range(0, len(values), 128)
    return b"".join(bytes((len(values[i : i + 128]), *values[i : i + 128])) for i in starts)


def hdr(rows: Iterable[Sequence[Color]], width: int, height: int) -> Iterator[bytes]:
    """A Radiance picture with run-length encoded rows; width from 8 to 32767."""
    yield f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n".encode("ascii")
    for pixels in rows:
        yield bytes((2, 2, width >> 8, width & 255))
        yield from map(component_bytes, zip(*map(rgbe, pixels), strict=True))
