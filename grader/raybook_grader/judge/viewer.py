"""The picture viewer as a piece of HTML that any page can embed, and that works offline.

It holds the pictures' own numbers, so that exposure and the values under the cursor are true.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from markupsafe import Markup

from ..page import environment, visible
from ..page.assets import File
from .display import BLUE_RED, MAGMA, coloured, png_data_uri, tone_mapped
from .numbers import packed
from .pixels import Array, Image, Map, luminance
from .tiles import spread, tile_means
from .viewing import viewing_of

MAX_SHOWN = 1 << 20  # pixels; a larger picture is shown reduced: 12 bytes a pixel, packed
_BIAS_TILE = 8  # pixels: enough to see through the noise, few enough to see where
_BIAS_SHOWN = 0.1  # the ends of the "darker or brighter" scale
_SCALE_STEPS = 72  # pixels of a colour scale

VIEWER_STYLES: tuple[File, ...] = ((__package__ or "", "viewer.css"),)
VIEWER_SCRIPTS: tuple[File, ...] = tuple(
    (__package__ or "", f"viewer{part}.js") for part in ("_numbers", "_paint", "_readout", "")
)
"""What a page with viewers needs, once."""


@dataclass(frozen=True)
class ErrorMap:
    """A map by pixel, shown in false colour from `low` to `high`."""

    name: str
    values: Map
    low: float
    high: float
    unit: str = ""
    colours: tuple[str, ...] = MAGMA


@dataclass(frozen=True)
class Fact:
    """A number about two pictures, and what it means."""

    name: str
    value: str
    meaning: str


def viewer_html(
    reference: Image,
    test: Image,
    error_map: Map,
    title: str,
    *,
    delta_e: Map | None = None,
    white: float | None = None,
    test_name: str = "Yours",
    facts: Sequence[Fact] = (),
) -> str:
    """A `<figure>` that shows two pictures of one size, their error maps and facts about them.

    `error_map` is FLIP's, `delta_e` Delta E ITP's. `white` is the radiance shown as white at
    exposure 0 (default: from the reference). Everything is escaped.
    """
    if reference.shape != test.shape or reference.shape[:2] != error_map.shape:
        raise ValueError(f"sizes differ: {reference.shape}, {test.shape}, {error_map.shape}")
    white = white or viewing_of(reference).white
    test_name = visible(test_name)
    step = _reduction(error_map.shape)
    reference, test = _reduced(reference, step), _reduced(test, step)
    maps = _maps(reference, test, _reduced(error_map, step), delta_e, step)
    names = [("Reference", reference), (test_name, test)]
    template = environment(__package__ or "").get_template("viewer.html")
    return template.render(
        title=title,
        step=step,
        width=reference.shape[1],
        height=reference.shape[0],
        # Without a script, and before it has run, these are seen.
        pictures=[(name, Markup(png_data_uri(tone_mapped(image, white)))) for name, image in names],
        maps=[(m, _picture(m) if m is maps[0] else "", _scale(m)) for m in maps],
        facts=facts,
        data=_data(names, maps, white),
    )


def _maps(
    reference: Image, test: Image, flip: Map, delta_e: Map | None, step: int
) -> list[ErrorMap]:
    maps = [ErrorMap("FLIP", flip, 0.0, _scale_end(flip, (0.1, 0.2, 0.5, 1.0)))]
    if delta_e is not None:
        shown = _reduced(delta_e, step)
        end = _scale_end(shown, (2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0))
        maps.append(ErrorMap("\N{GREEK CAPITAL LETTER DELTA}E ITP", shown, 0.0, end))
    return [*maps, _signed_map(reference, test)]


def _data(
    pictures: Sequence[tuple[str, Image]], maps: Sequence[ErrorMap], white: float
) -> dict[str, Any]:
    height, width = maps[0].values.shape
    return {
        "width": width,
        "height": height,
        "white": white,
        "pictures": [{"name": name, "data": packed(image)} for name, image in pictures],
        "maps": [
            {"name": m.name, "unit": m.unit, "low": m.low, "high": m.high}
            | {"colours": m.colours, "data": packed(m.values)}
            for m in maps
        ],
        "start": _worst_pixel(maps),
    }


def _picture(shown: ErrorMap) -> Markup:
    return Markup(png_data_uri(coloured(shown.values, shown.low, shown.high, shown.colours)))


def _scale(shown: ErrorMap) -> Markup:
    steps = np.linspace(0.0, 1.0, _SCALE_STEPS)[np.newaxis]
    return Markup(png_data_uri(coloured(steps, 0.0, 1.0, shown.colours)))


def _signed_map(reference: Image, test: Image) -> ErrorMap:
    """Too dark or too bright, averaged over small tiles: noise cancels, bias stays."""
    seen, expected = (luminance(np.nan_to_num(image)) for image in (test, reference))
    shape = (expected.shape[0], expected.shape[1])
    means = tile_means(expected, _BIAS_TILE)
    floor = 0.05 * float(expected.mean()) + 1e-30
    relative = (tile_means(seen, _BIAS_TILE) - means) / (means + floor)
    values = np.clip(100 * spread(relative, shape, _BIAS_TILE), -6e4, 6e4).astype(np.float32)
    end = 100 * _BIAS_SHOWN
    return ErrorMap("Darker or brighter", values, -end, end, "%", BLUE_RED)


def _worst_pixel(maps: Sequence[ErrorMap]) -> list[int]:
    """(x, y) to show first: by Delta E, which is each pixel's own, where there is one."""
    values = maps[-2].values
    y, x = np.unravel_index(int(np.argmax(np.nan_to_num(values))), values.shape)
    return [int(x), int(y)]


def _scale_end(values: Map, ends: Sequence[float]) -> float:
    """A round end for the colour scale that nearly all of the picture stays below."""
    top = float(np.percentile(values, 99.5))
    return next((end for end in ends if top <= end), ends[-1])


def _reduction(shape: tuple[int, ...]) -> int:
    return int(np.ceil(np.sqrt(max(shape[0] * shape[1] / MAX_SHOWN, 1.0))))


def _reduced(values: Image | Map, step: int) -> Image:
    """Means of `step` x `step` pixels."""
    if step == 1:
        return np.asarray(values, dtype=np.float32)
    planes: Array = np.moveaxis(np.atleast_3d(values).astype(np.float64), -1, 0)
    means = np.moveaxis(tile_means(planes, step), 0, -1).astype(np.float32)
    return means if values.ndim == 3 else means[..., 0]
