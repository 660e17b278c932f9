"""From radiance and error values to 8-bit pictures, and to PNG."""

import base64
import io

import numpy as np
from numpy.typing import NDArray
from PIL import Image as Picture

from .pixels import Array, Image, Map

Bytes = NDArray[np.uint8]  # (height, width, 3), sRGB

INVALID = (255, 0, 255)  # NaN and infinities: a colour that no tone curve makes by itself

# Nine steps each, blended linearly in sRGB. Magma is FLIP's own (Smith and van der Walt, CC0).
MAGMA = ("000004", "1d1147", "51127c", "822681", "b63679", "e65164", "fb8861", "fec287", "fcfdbf")
BLUE_RED = (
    "0b3c7d",
    "2f6fb5",
    "6ba7d6",
    "b9d7ea",
    "f2f2f2",
    "f6c8ae",
    "e58a68",
    "c7423e",
    "7f0d22",
)


def tone_mapped(image: Image, white: float) -> Bytes:
    """sRGB with radiance `white` at 1, cut off above; the viewer's JavaScript does the same."""
    linear = np.clip(np.nan_to_num(image, nan=0.0, posinf=0.0) / white, 0.0, 1.0)
    # IEC 61966-2-1
    curved = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
    shown: Bytes = (255 * curved + 0.5).astype(np.uint8)
    shown[~np.isfinite(image).all(axis=-1)] = INVALID
    return shown


def coloured(values: Map | Array, low: float, high: float, steps: tuple[str, ...] = MAGMA) -> Bytes:
    """A false-colour picture: `low` is the first step's colour, `high` the last's."""
    colours = np.array([[int(step[i : i + 2], 16) for i in (0, 2, 4)] for step in steps])
    share = (np.nan_to_num(np.asarray(values, np.float64)) - low) / (high - low)
    place = np.clip(share, 0.0, 1.0) * (len(steps) - 1)
    stops = np.arange(len(steps))
    planes = [np.interp(place, stops, colours[:, channel]) for channel in range(3)]
    shown: Bytes = (np.stack(planes, axis=-1) + 0.5).astype(np.uint8)
    return shown


def png_data_uri(pixels: Bytes) -> str:
    """`data:image/png;base64,...`"""
    buffer = io.BytesIO()
    Picture.fromarray(pixels, "RGB").save(buffer, "PNG", optimize=True)
    return "data:image/png;base64," + base64.b64encode(buffer.getvalue()).decode("ascii")
