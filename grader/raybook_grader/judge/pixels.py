"""Array types and the luminance that every part of the judge shares."""

import numpy as np
from numpy.typing import NDArray

Image = NDArray[np.float32]  # (height, width, 3), linear Rec. 709, row 0 is the top
Map = NDArray[np.float32]  # (height, width)
Mask = NDArray[np.bool_]  # (height, width)
Array = NDArray[np.float64]

LUMINANCE = np.array([0.2126, 0.7152, 0.0722])  # ITU-R BT.709-6, item 3.2
CHANNELS = ("red", "green", "blue")


def luminance(image: Image | Array) -> Array:
    """Rec. 709 luminance of the last axis, in double precision."""
    weighted: Array = np.asarray(image, dtype=np.float64) @ LUMINANCE
    return weighted
