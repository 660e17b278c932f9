"""Pixels as text in a page: exact, and as small as deflate makes them."""

import base64
import zlib

import numpy as np

from .pixels import Image, Map


def packed(values: Image | Map) -> str:
    """Base64 of zlib of the float32 values, none rounded, in reading order.

    All first bytes (little-endian) come first, then all second ones, and so on: neighbours have
    the same sign and exponent, so this packs a quarter better than the values in a row.
    """
    raw = np.ascontiguousarray(values, dtype="<f4").reshape(-1).view(np.uint8)
    planes = np.ascontiguousarray(raw.reshape(-1, 4).T)
    return base64.b64encode(zlib.compress(planes.tobytes(), 9)).decode("ascii")


def unpacked(text: str) -> np.ndarray[tuple[int], np.dtype[np.float32]]:
    """The inverse of `packed`, as a flat array: what the viewer's script does."""
    planes = np.frombuffer(zlib.decompress(base64.b64decode(text)), np.uint8)
    return np.ascontiguousarray(planes.reshape(4, -1).T).view("<f4")[:, 0]
