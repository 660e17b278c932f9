"""The picture viewer as a piece of HTML that any page can embed, and that works offline.

It holds the pictures' own numbers, so that exposure and the values under the cursor are true.
"""

import base64
import functools
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import jinja2
import numpy as np
from markupsafe import Markup

from .display import BLUE_RED, MAGMA, coloured, png_data_uri, tone_mapped
from .pixels import Array, Image, Map, luminance
from .tiles import spread, tile_means
from .viewing import viewing_of

MAX_SHOWN = 1 << 20  # pixels; a larger picture is shown reduced: 6 bytes a pixel, in base64
_BIAS_TILE = 8  # pixels: enough to see through the noise, few enough to see where
_BIAS_SHOWN = 0.1  # the ends of the "darker or brighter" scale
_HALF_MAX = 65504.0
_HALF_NEEDS_WHITE = 0.1  # half floats keep 0.1 % of values down to 6e-5: eleven stops below this


@dataclass(frozen=True)
class ErrorMap:
    """A map by pixel, shown in false colour from `low` to `high`."""

    name: str
    values: Map
    low: float
    high: float
    unit: str = ""
    colours: tuple[str, ...] = MAGMA


def viewer_html(
    reference: Image,
    test: Image,
    error_map: Map,
    title: str,
    *,
    delta_e: Map | None = None,
    white: float | None = None,
    test_name: str = "Yours",
    assets: bool = True,
) -> str:
    """A `<figure>` that shows two pictures of one size and their error maps.

    `error_map` is FLIP's, `delta_e` Delta E ITP's. `white` is the radiance shown as white at
    exposure 0 (default: from the reference). Everything is escaped. With several on a page, give
    `assets` once.
    """
    if reference.shape != test.shape or reference.shape[:2] != error_map.shape:
        raise ValueError(f"sizes differ: {reference.shape}, {test.shape}, {error_map.shape}")
    white = white or viewing_of(reference).white
    step = _reduction(error_map.shape)
    reference, test = _reduced(reference, step), _reduced(test, step)
    flip = _reduced(error_map, step)
    maps = [ErrorMap("FLIP", flip, 0.0, _scale_end(flip, (0.1, 0.2, 0.5, 1.0)))]
    if delta_e is not None:
        shown = _reduced(delta_e, step)
        end = _scale_end(shown, (2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0))
        maps.append(ErrorMap("\N{GREEK CAPITAL LETTER DELTA}E ITP", shown, 0.0, end))
    maps.append(_signed_map(reference, test))
    return (viewer_assets() if assets else "") + _environment().get_template("viewer.html").render(
        title=title,
        step=step,
        pictures=[
            ("Reference", png_data_uri(tone_mapped(reference, white))),
            (test_name, png_data_uri(tone_mapped(test, white))),
        ],
        maps=[(m, png_data_uri(coloured(m.values, m.low, m.high, m.colours))) for m in maps],
        data=_data(reference, test, maps, white, test_name) | {"start": _worst_pixel(maps)},
    )


def viewer_assets() -> str:
    """The style and script that `viewer_html` needs, once a page, before or after it."""
    return _environment().get_template("viewer_assets.html").render()


def page_html(template: str, **values: Any) -> str:
    """Render one of this package's pages; values are escaped, those marked safe excepted."""
    return _environment().get_template(template).render(**values)


@functools.cache
def _environment() -> jinja2.Environment:
    environment = jinja2.Environment(
        loader=jinja2.PackageLoader("raybook_grader.judge", "templates"),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.globals["gradient"] = _gradient
    environment.globals["source"] = lambda name: Markup(
        environment.get_template(name).render()  # our own files
    )
    return environment


def _data(
    reference: Image, test: Image, maps: Sequence[ErrorMap], white: float, test_name: str
) -> dict[str, Any]:
    height, width = reference.shape[:2]
    return {
        "width": width,
        "height": height,
        "white": white,
        "pictures": [
            {"name": name, **_numbers(image, exact=white < _HALF_NEEDS_WHITE)}
            for name, image in (("Reference", reference), (test_name, test))
        ],
        "maps": [
            {"name": m.name, "unit": m.unit, "low": m.low, "high": m.high}
            | {"colours": m.colours, **_numbers(m.values)}
            for m in maps
        ],
    }


def _numbers(values: Image | Map, exact: bool = False) -> dict[str, str]:
    """Half floats, which keep three figures, or floats where those don't fit; base64."""
    largest = np.abs(values[np.isfinite(values)]).max(initial=0.0)
    kind = "<f4" if exact or largest > _HALF_MAX else "<f2"
    raw = np.ascontiguousarray(values, dtype=np.dtype(kind)).tobytes()
    return {"format": kind[1:], "data": base64.b64encode(raw).decode("ascii")}


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


def _gradient(steps: Sequence[str]) -> str:
    return "linear-gradient(to right, " + ", ".join(f"#{step}" for step in steps) + ")"
