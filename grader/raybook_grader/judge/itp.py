"""Delta E ITP (ITU-R BT.2124): colour difference in just noticeable steps, for HDR pictures."""

import functools
import warnings
from dataclasses import dataclass
from types import ModuleType

import numpy as np

from .pixels import Array, Image, Map

WHITE_LUMINANCE = 203.0  # cd/m2 of diffuse white: ITU-R BT.2408, section 2.1
PEAK_LUMINANCE = 10000.0  # cd/m2: the end of PQ's range

# Linear BT.709 to linear BT.2020: ITU-R BT.2087-0, section 2.
_BT709_TO_BT2020 = np.array(
    [[0.6274, 0.3293, 0.0433], [0.0691, 0.9195, 0.0114], [0.0164, 0.0880, 0.8956]]
)


@dataclass(frozen=True)
class ColourDifference:
    """1 is the smallest difference that the most sensitive viewing shows."""

    mean: float
    p95: float
    map: Map


def colour_difference(reference: Image, test: Image, white: float) -> ColourDifference:
    """Of two pictures in linear Rec. 709; radiance `white` is shown at 203 cd/m2."""
    colour = _colour()
    pair = (_absolute_bt2020(image, white) for image in (reference, test))
    ictcp = [colour.RGB_to_ICtCp(image, method="ITU-R BT.2100-2 PQ") for image in pair]
    difference = np.asarray(colour.difference.delta_E_ITP(*ictcp), dtype=np.float32)
    return ColourDifference(
        float(difference.mean(dtype=np.float64)), float(np.percentile(difference, 95)), difference
    )


def _absolute_bt2020(image: Image, white: float) -> Array:
    luminous = np.asarray(image, dtype=np.float64) * (WHITE_LUMINANCE / white)
    clean = np.clip(np.nan_to_num(luminous, nan=0.0, posinf=PEAK_LUMINANCE), 0.0, PEAK_LUMINANCE)
    converted: Array = np.clip(clean @ _BT709_TO_BT2020.T, 0.0, PEAK_LUMINANCE)
    return converted


@functools.cache
def _colour() -> ModuleType:
    """colour-science, late: it takes half a second, and warns of each library it could use.

    It also changes how NumPy prints numbers everywhere, which would change what students read.
    """
    with warnings.catch_warnings(), np.printoptions():
        warnings.simplefilter("ignore")
        import colour
    return colour
