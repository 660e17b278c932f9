"""Write the images of the scenes in scenes/test/compare: python make_images.py build/compare

Fixed seeds and formulas; no picture is symmetric in any way, so that a flip or a quarter turn
shows. EXR files are linear; the PNG is sRGB.
"""

import struct
import sys
import zlib
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from raybook_grader.files import write_bytes
from raybook_grader.judge.exr import write_exr


def sky(width: int = 64, height: int = 32) -> NDArray[np.float32]:
    """A blue gradient around the pole (row 0), a red and a green blob, and a sun of 2 x 1 texels
    that is 1000 times as bright as the rest."""
    rows, columns = np.mgrid[0:height, 0:width]
    v, u = (rows + 0.5) / height, (columns + 0.5) / width
    image = np.stack([0.2 + 0.3 * v, 0.3 + 0.1 * v, 0.9 - 0.7 * v], axis=-1)
    blobs = (((2.0, 0.1, 0.1), (0.2, 0.4, 0.06)), ((0.1, 1.5, 0.1), (0.7, 0.7, 0.1)))
    for color, (u0, v0, size) in blobs:
        blob = np.exp(-((u - u0) ** 2 + (v - v0) ** 2) / size**2)
        image += blob[..., None] * np.array(color)
    image[9, 20:22] = (600.0, 500.0, 400.0)
    return image.astype(np.float32)


def pattern(width: int, height: int, seed: int) -> NDArray[np.float32]:
    """Random reflectances from 0.05 to 0.95."""
    random = np.random.default_rng(seed)
    return (0.05 + 0.9 * random.random((height, width, 3))).astype(np.float32)


def write_png(path: Path, pixels: NDArray[np.uint8]) -> None:
    """An 8-bit RGB file (PNG specification, third edition): one filterless block of data."""
    height, width = pixels.shape[:2]
    rows = b"".join(b"\0" + row.tobytes() for row in pixels)

    def chunk(kind: bytes, data: bytes) -> bytes:
        checksum = struct.pack(">I", zlib.crc32(kind + data))
        return struct.pack(">I", len(data)) + kind + data + checksum

    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    parts = (chunk(b"IHDR", header), chunk(b"IDAT", zlib.compress(rows)), chunk(b"IEND", b""))
    data = b"\x89PNG\r\n\x1a\n" + b"".join(parts)
    write_bytes(path, data)


def make_images(folder: Path) -> None:
    """Write all of them; the folder is made."""
    folder.mkdir(parents=True, exist_ok=True)
    write_exr(folder / "sky.exr", sky())
    write_exr(folder / "pattern.exr", pattern(5, 3, seed=1))
    write_exr(folder / "squares.exr", pattern(4, 4, seed=2))
    write_png(folder / "codes.png", (255 * pattern(7, 4, seed=3)).astype(np.uint8))


if __name__ == "__main__":
    make_images(Path(sys.argv[1]))
