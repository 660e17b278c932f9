"""Clear and clouded skies with a sun, as environment maps.

The sky's colour: A. J. Preetham, P. Shirley, B. Smits, "A Practical Analytic Model for Daylight",
SIGGRAPH 1999, appendix A.2. The sun is drawn larger than the real one (0.27 degrees) so that
a map of 1024 texels can hold it, and the clouds are noise on a plane overhead.

Local frame of an environment map: the pole +z is the image's top row, u = phi / 2 pi.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

from image_files import Color
from noise import Columns, row

Vec = tuple[float, float, float]


@dataclass(frozen=True)
class Sky:
    """What a sky is like. Radiances are in the scenes' units: a bright sky is about 0.5."""

    sun_elevation: float  # degrees
    sun_azimuth: float  # degrees from +x towards +y
    sun_radius: float  # degrees
    sun_irradiance: Color  # on a surface that faces the sun
    turbidity: float = 2.5  # haze; 2 is clear, 6 is hazy
    exposure: float = 0.05  # radiance of 1 kcd / m^2
    clouds: float = 0.0  # share of the sky that is covered, about
    ground: Color = (0.1, 0.09, 0.08)  # radiance below the horizon
    haze: Color = (0.62, 0.68, 0.75)  # radiance at the horizon

    @cached_property
    def sun(self) -> Vec:
        """The direction to the sun."""
        e, a = math.radians(self.sun_elevation), math.radians(self.sun_azimuth)
        return (math.cos(e) * math.cos(a), math.cos(e) * math.sin(a), math.sin(e))

    @cached_property
    def sun_radiance(self) -> Color:
        """Of the disc, everywhere the same."""
        solid_angle = math.pi * math.sin(math.radians(self.sun_radius)) ** 2
        r, g, b = self.sun_irradiance
        return (r / solid_angle, g / solid_angle, b / solid_angle)


# Preetham's coefficients, a pair (slope, offset) in turbidity each, of Perez' formula for
# the luminance Y and the chromaticities x and y.
PEREZ = (
    ((0.1787, -1.4630), (-0.3554, 0.4275), (-0.0227, 5.3251), (0.1206, -2.5771), (-0.0670, 0.3703)),
    (
        (-0.0193, -0.2592),
        (-0.0665, 0.0008),
        (-0.0004, 0.2125),
        (-0.0641, -0.8989),
        (-0.0033, 0.0452),
    ),
    (
        (-0.0167, -0.2608),
        (-0.0950, 0.0092),
        (-0.0079, 0.2102),
        (-0.0441, -1.6537),
        (-0.0109, 0.0529),
    ),
)

# Of the zenith's x and y: rows for turbidity^2, turbidity, 1; columns for theta^3 .. theta^0.
ZENITH = (
    (
        (0.00166, -0.00375, 0.00209, 0.0),
        (-0.02903, 0.06377, -0.03202, 0.00394),
        (0.11693, -0.21196, 0.06052, 0.25886),
    ),
    (
        (0.00275, -0.00610, 0.00317, 0.0),
        (-0.04214, 0.08970, -0.04153, 0.00516),
        (0.15346, -0.26756, 0.06670, 0.26688),
    ),
)


def zenith(sky: Sky) -> Vec:
    """Y (kcd / m^2), x and y straight up."""
    t, theta = sky.turbidity, math.radians(90 - sky.sun_elevation)
    chi = (4 / 9 - t / 120) * (math.pi - 2 * theta)
    luminance = (4.0453 * t - 4.9710) * math.tan(chi) - 0.2155 * t + 2.4192
    x, y = (
        sum(
            c * t ** (2 - i) * theta ** (3 - k)
            for i, line in enumerate(table)
            for k, c in enumerate(line)
        )
        for table in ZENITH
    )
    return luminance, x, y


def perez(c: tuple[float, ...], cos_theta: float, gamma: float) -> float:
    """R. Perez' all-weather sky: theta from the zenith, gamma from the sun."""
    a, b, cc, d, e = c
    halo = 1 + cc * math.exp(d * gamma) + e * math.cos(gamma) ** 2
    return (1 + a * math.exp(b / max(cos_theta, 0.01))) * halo


def rgb_of(luminance: float, x: float, y: float) -> Color:
    """Linear RGB, Rec. 709 primaries, from CIE xyY."""
    big_x, big_z = x / y * luminance, (1 - x - y) / y * luminance
    return (
        max(3.2406 * big_x - 1.5372 * luminance - 0.4986 * big_z, 0.0),
        max(-0.9689 * big_x + 1.8758 * luminance + 0.0415 * big_z, 0.0),
        max(0.0557 * big_x - 0.2040 * luminance + 1.0570 * big_z, 0.0),
    )


class Clouds:
    """How much of the sky's light clouds hide, on a plane one unit overhead.

    A grid of noise over [-REACH, REACH]^2; beyond it there are none.
    """

    GRID, REACH = 512, 5.0

    def __init__(self, cover: float) -> None:
        self.cover = cover
        self.rows = [self.grid_row(j) for j in range(self.GRID)]

    def grid_row(self, j: int) -> list[float]:
        """Fractal noise along one row, about -1 .. 1."""
        total = [0.0] * self.GRID
        for octave in range(5):
            step = 2 * self.REACH / self.GRID * 0.8 * 2**octave
            columns = self.columns[octave]
            noise = row(columns, (j + 0.5) * step, 100 + octave)
            total = [t + n / 2**octave for t, n in zip(total, noise, strict=True)]
        return total

    @cached_property
    def columns(self) -> list[Columns]:
        """The grid's x at each octave."""
        steps = [2 * self.REACH / self.GRID * 0.8 * 2**octave for octave in range(5)]
        return [Columns([(i + 0.5) * step for i in range(self.GRID)]) for step in steps]

    def density(self, x: float, y: float) -> float:
        """0 is blue sky, 1 a thick cloud."""
        gx = (x / self.REACH + 1) / 2 * (self.GRID - 1)
        gy = (y / self.REACH + 1) / 2 * (self.GRID - 1)
        i, j = int(gx), int(gy)
        if not (0 <= i < self.GRID - 1 and 0 <= j < self.GRID - 1):
            return 0.0
        s, t, above, below = gx - i, gy - j, self.rows[j], self.rows[j + 1]
        first = above[i] + s * (above[i + 1] - above[i])
        second = below[i] + s * (below[i + 1] - below[i])
        d = (first + t * (second - first) + self.cover - 0.35) * 1.8
        return min(max(d, 0.0), 1.0)


def with_clouds(clouds: Clouds, sky: Sky, d: Vec, blue: Color, white: Color) -> Color:
    """The sky's colour in direction d seen through the clouds; they are lit from the sun's side."""
    x, y = d[0] / (d[2] + 0.08), d[1] / (d[2] + 0.08)
    here = clouds.density(x, y)
    if here == 0.0:
        return blue
    beside = clouds.density(x + 0.12 * sky.sun[0], y + 0.12 * sky.sun[1])
    light = math.exp(-0.9 * beside) * (1 - 0.25 * here)
    cover = here * min(d[2] * 5.0, 1.0)
    cover = cover * (2 - cover)
    r, g, b = (s + cover * (w * light - s) for s, w in zip(blue, white, strict=True))
    return (r, g, b)


def hazy(sky: Sky, z: float, color: Color) -> Color:
    """The colour, mixed with the haze within a few degrees of the horizon."""
    share = math.exp(-abs(z) * (12.0 if z > 0 else 40.0))
    r, g, b = (c + share * (h - c) for c, h in zip(color, sky.haze, strict=True))
    return (r, g, b)


def with_sun(sky: Sky, gamma: float, texel: float, color: Color) -> Color:
    """Adds the disc's share of a texel (its height in radians) whose middle is gamma from it."""
    share = min(max((math.radians(sky.sun_radius) - gamma) / texel + 0.5, 0.0), 1.0)
    r, g, b = (c + share * s for c, s in zip(color, sky.sun_radiance, strict=True))
    return (r, g, b)


class Painter:
    """Computes the texels of one sky."""

    def __init__(self, sky: Sky, width: int, height: int) -> None:
        self.sky, self.texel = sky, math.pi / height
        self.perez = [tuple(k * sky.turbidity + c for k, c in table) for table in PEREZ]
        theta = math.radians(90 - sky.sun_elevation)
        self.scale = [
            z / perez(c, 1.0, theta) for z, c in zip(zenith(sky), self.perez, strict=True)
        ]
        self.clouds = Clouds(sky.clouds) if sky.clouds > 0 else None
        r, g, b = sky.sun_irradiance
        self.white: Color = (0.42 * r, 0.42 * g, 0.42 * b)
        turns = [2 * math.pi * (i + 0.5) / width for i in range(width)]
        self.turns = [(math.cos(phi), math.sin(phi)) for phi in turns]

    def color(self, d: Vec) -> Color:
        """The radiance from direction d above the horizon."""
        cosine = sum(a * b for a, b in zip(d, self.sky.sun, strict=True))
        gamma = math.acos(min(max(cosine, -1.0), 1.0))
        luminance, x, y = (
            s * perez(c, d[2], gamma) for s, c in zip(self.scale, self.perez, strict=True)
        )
        color = rgb_of(luminance * self.sky.exposure, x, y)
        color = hazy(self.sky, d[2], color)
        if self.clouds:
            color = with_clouds(self.clouds, self.sky, d, color, self.white)
        return with_sun(self.sky, gamma, self.texel, color)

    def row(self, theta: float) -> list[Color]:
        """One row of the map."""
        z, r = math.cos(theta), math.sin(theta)
        if z < 0:
            return [hazy(self.sky, z, self.sky.ground)] * len(self.turns)
        return [self.color((r * c, r * s, z)) for c, s in self.turns]


def sky_rows(sky: Sky, width: int, height: int) -> Iterator[list[Color]]:
    """The map's rows from the zenith to the nadir."""
    painter = Painter(sky, width, height)
    for j in range(height):
        yield painter.row(math.pi * (j + 0.5) / height)
