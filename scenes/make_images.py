"""Write the textures and environment maps of the demo and test scenes.

    python3 scenes/make_images.py build/images

Needs only Python 3.11's standard library. Everything is computed from formulas and fixed seeds.
A file is complete or absent; if the scripts have not changed since the last run and all files
are there, nothing is written.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Iterator
from pathlib import Path

from generated import Maker, command
from image_files import Color, hdr, png
from noise import Columns, row
from sky import Sky, sky_rows

# Skies -----------------------------------------------------------------------------------------

SUNNY = Sky(
    sun_elevation=42,
    sun_azimuth=215,
    sun_radius=0.8,
    sun_irradiance=(3.4, 3.15, 2.8),
    turbidity=2.5,
    exposure=0.055,
    clouds=0.3,
    ground=(0.20, 0.19, 0.17),
)

EVENING = Sky(
    sun_elevation=22,
    sun_azimuth=188,
    sun_radius=0.7,
    sun_irradiance=(4.6, 3.7, 2.6),
    turbidity=2.6,
    exposure=0.075,
    clouds=0.3,
)


def sky_file(sky: Sky) -> Iterator[bytes]:
    """An environment map, twice as wide as high."""
    width, height = 1024, 512
    return hdr(sky_rows(sky, width, height), width, height)


def sunny_sky() -> Iterator[bytes]:
    """Late morning, a few clouds."""
    return sky_file(SUNNY)


def evening_sky() -> Iterator[bytes]:
    """A low sun."""
    return sky_file(EVENING)


def compass() -> Iterator[bytes]:
    """An environment map that no turn or mirror image of it resembles, with a small bright patch.

    Along u the colours are red, yellow, green, blue; the upper half (towards the pole +z) is
    brighter than the lower one. The patch is at u = 3/32 .. 1/8, v = 1/4 .. 5/16.
    """
    width, height = 64, 32
    colors = ((0.9, 0.12, 0.08), (0.8, 0.65, 0.1), (0.1, 0.6, 0.15), (0.1, 0.2, 0.9))
    rows = []
    for j in range(height):
        strength = 1.0 if j < height // 2 else 0.3
        pixels = [scaled(colors[i * 4 // width], strength) for i in range(width)]
        if 8 <= j < 10:
            pixels[6:8] = [(120.0, 110.0, 90.0)] * 2
        rows.append(pixels)
    return hdr(rows, width, height)


def scaled(color: Color, k: float) -> Color:
    """k times the colour."""
    return (k * color[0], k * color[1], k * color[2])


# Surfaces --------------------------------------------------------------------------------------


def mixed(a: Color, b: Color, share: float) -> Color:
    """From a to b as share goes from 0 to 1, and not beyond."""
    s = min(max(share, 0.0), 1.0)
    return (a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1]), a[2] + s * (b[2] - a[2]))


def checker() -> Iterator[bytes]:
    """Two by two squares with sharp edges."""
    size = 256
    light, dark = (0.80, 0.77, 0.70), (0.035, 0.05, 0.075)
    return png(
        [[light if (i < 128) == (j < 128) else dark for i in range(size)] for j in range(size)]
    )


def fractal(columns: list[Columns], y: float, cells: int, seed: int) -> list[float]:
    """Octaves of noise along a row; y in 0 .. 1, the first octave has so many cells across."""
    total = [0.0] * sum(len(samples) for samples in columns[0].samples)
    for octave, across in enumerate(columns):
        noise = row(across, y * cells / 2 * 2**octave, seed + octave)
        total = [t + n / 2**octave for t, n in zip(total, noise, strict=True)]
    return total


def around(width: int, cells: int, octaves: int) -> list[Columns]:
    """The columns of a map whose left and right edges fit together."""
    return [
        Columns([(i + 0.5) / width * (cells << k) for i in range(width)], cells << k)
        for k in range(octaves)
    ]


def planet() -> Iterator[bytes]:
    """Seas, land, deserts and ice: a map of a sphere."""
    width, height = 768, 384
    land, moist = around(width, 6, 6), around(width, 4, 4)
    rows = []
    for j in range(height):
        v = (j + 0.5) / height
        latitude = abs(1 - 2 * v)
        ground, rain = fractal(land, v, 6, 200), fractal(moist, v, 4, 220)
        rows.append([planet_color(h, m, latitude) for h, m in zip(ground, rain, strict=True)])
    return png(rows)


def planet_color(height: float, rain: float, latitude: float) -> Color:
    """latitude: 0 at the equator, 1 at a pole."""
    height -= 0.02
    sea = mixed((0.012, 0.05, 0.16), (0.03, 0.22, 0.30), 1 + 6 * height)
    plains = mixed((0.42, 0.30, 0.14), (0.07, 0.17, 0.04), 1.9 * rain + 0.2 + 1.1 * latitude)
    hills = mixed(plains, (0.27, 0.20, 0.14), 3.2 * height - 0.5)
    color = mixed(sea, hills, 40 * height)
    return mixed(color, (0.82, 0.86, 0.90), 14 * (latitude + 0.25 * height - 0.80))


def beach_ball() -> Iterator[bytes]:
    """Twelve gores, every second one white, and caps at the poles: a map of a sphere."""
    colors = (
        (0.80, 0.05, 0.04),
        (0.85, 0.42, 0.02),
        (0.80, 0.66, 0.05),
        (0.05, 0.36, 0.10),
        (0.03, 0.20, 0.62),
        (0.32, 0.06, 0.40),
    )
    white = (0.82, 0.82, 0.80)
    gores = [colors[i * 12 // 768 // 2] if i * 12 // 768 % 2 else white for i in range(768)]
    return png([[white] * 768 if j < 24 or j >= 360 else gores for j in range(384)])


def marble() -> Iterator[bytes]:
    """White stone with dark veins: a map of a sphere."""
    width, height = 768, 384
    waves, veins = around(width, 4, 6), around(width, 4, 5)
    rows = []
    for j in range(height):
        v = (j + 0.5) / height
        cloud, fold = fractal(waves, v, 4, 300), fractal(veins, v, 4, 320)
        rows.append([marble_color(a, b) for a, b in zip(cloud, fold, strict=True)])
    return png(rows)


def marble_color(cloud: float, fold: float) -> Color:
    """Veins are where the folded noise crosses zero."""
    stone = mixed((0.70, 0.69, 0.66), (0.50, 0.52, 0.53), 0.3 + 1.2 * cloud)
    vein = math.exp(-abs(fold) * 22) * min(max(0.7 + 1.5 * cloud, 0.0), 1.0)
    return mixed(stone, (0.10, 0.09, 0.10), vein)


LETTER = ("11110", "10000", "11100", "10000", "10000")


def letter() -> Iterator[bytes]:
    """An F on a ground that gets redder along u and greener along v: shows every flip and turn."""
    size = 128
    return png([[letter_color(i, j, size) for i in range(size)] for j in range(size)])


def letter_color(i: int, j: int, size: int) -> Color:
    """Column i from the left, row j from the top."""
    x, y = i * 8 // size - 1, j * 8 // size - 1
    if 0 <= x < 5 and 0 <= y < 5 and LETTER[y][x] == "1":
        return (0.02, 0.02, 0.03)
    return (0.1 + 0.7 * i / size, 0.1 + 0.7 * j / size, 0.35)


IMAGES: dict[str, Maker] = {
    "sunny-sky.hdr": sunny_sky,
    "evening-sky.hdr": evening_sky,
    "planet.png": planet,
    "marble.png": marble,
    "beach-ball.png": beach_ball,
    "checker.png": checker,
    "letter.png": letter,
    "compass.hdr": compass,
}

HERE = Path(__file__).parent
SOURCES = [
    HERE / f"{name}.py" for name in ("make_images", "generated", "image_files", "noise", "sky")
]

if __name__ == "__main__":
    sys.exit(command("make_images.py", IMAGES, SOURCES, sys.argv[1:]))
