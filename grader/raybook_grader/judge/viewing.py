"""How bright a picture is shown: fixed once for a scene, from its reference."""

from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from .pixels import Image, luminance

MIDDLE_GREY = 0.18
MAX_EXPOSURES = 12  # stops between FLIP's ends: 3 decades and a half; each costs one evaluation
PIXELS_PER_DEGREE = 67.0206  # FLIP's default: a 0.7 m wide 3840-pixel display at 0.7 m
_SHOULDER = 0.85  # FLIP's exposure bounds: where its tone curve bends


@dataclass(frozen=True)
class Viewing:
    """`white`: the radiance shown as diffuse white, for Delta E and for a viewer's exposure 0.

    The others are HDR-FLIP's exposures in stops and the display's resolution.
    """

    white: float
    start_exposure: float
    stop_exposure: float
    exposures: int
    pixels_per_degree: float = PIXELS_PER_DEGREE

    def as_json(self) -> dict[str, Any]:
        """Plain values to store with a scene; `Viewing(**values)` reads them."""
        return asdict(self)

    def flip_parameters(self) -> dict[str, float | int]:
        """What `flip_evaluator.evaluate` takes; start < stop always, which it relies on."""
        return {
            "ppd": self.pixels_per_degree,
            "startExposure": self.start_exposure,
            "stopExposure": self.stop_exposure,
            "numExposures": self.exposures,
        }


def viewing_of(reference: Image) -> Viewing:
    """Derive a scene's viewing from its converged reference.

    The exposures are FLIP's own (Andersson et al. 2021, "Visualizing Errors in Rendered High
    Dynamic Range Images", section 3): the brightest pixel, then the median one, is brought to
    where the tone curve bends. White is where the median is middle grey, as a camera's meter has
    it. Black pixels are left out, so that a mostly black picture is still shown.
    """
    grey = luminance(np.nan_to_num(reference, nan=0.0, posinf=0.0, neginf=0.0))
    lit = grey[grey > 1e-4 * grey.max()] if grey.max() > 0 else np.ones(1)
    bend = _tone_curve_inverse(_SHOULDER)
    start = float(np.log2(bend / lit.max()))
    stop = min(float(np.log2(bend / np.median(lit))), start + MAX_EXPOSURES)
    stop = max(stop, start + 1.0)
    return Viewing(
        white=float(np.median(lit)) / MIDDLE_GREY,
        start_exposure=start,
        stop_exposure=stop,
        exposures=max(2, int(np.ceil(stop - start))),
    )


def _tone_curve_inverse(value: float) -> float:
    """Where FLIP's default tone curve reaches `value`: Narkowicz's ACES fit at exposure 0.6."""
    a, b, c, d, e = 2.51 * 0.36, 0.03 * 0.6, 2.43 * 0.36, 0.59 * 0.6, 0.14
    # (a x^2 + b x) / (c x^2 + d x + e) = value, the positive root
    roots = np.roots([a - value * c, b - value * d, -value * e])
    return float(roots.max())
