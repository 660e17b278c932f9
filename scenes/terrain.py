"""A mountain range of a million triangles, with the colours of its ground.

Fractal noise whose finer octaves fade where the coarser ones are steep, as if water had smoothed
the slopes: F. K. Musgrave, C. Kolb, R. Mace, "The Synthesis and Rendering of Eroded Fractal
Terrains", SIGGRAPH 1989, for the fractal; the fading by slope is the simplest form of their
erosion. Two octaves are ridged: folded at zero, so that they have crests.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from functools import cache

from noise import Columns, row, row_with_slopes

Color = tuple[float, float, float]

COLUMNS, ROWS = 1000, 500
"""Cells of the grid, two triangles each."""
WIDTH, DEPTH = 12.0, 6.0
"""Kilometres: x from -WIDTH / 2 to WIDTH / 2, z from 0 (near) to -DEPTH (far)."""
CELL = WIDTH / COLUMNS
OCTAVES = 9
RIDGED = (1, 2)
"""These octaves have crests; they say nothing of slopes, which jump there."""
FIRST_WAVE = 2.6
"""Length of the longest waves, in kilometres."""
PEAK = 1.3
"""Height in kilometres of a full swing of the noise."""
WATER = 0.0
"""The lake's level; the ground below it is flat, it cannot be seen."""


def base(x: float, z: float) -> float:
    """Where mountains stand: about a lake near the viewer, highest at the back."""
    back = min(max((-z - 0.8) / 3.0, 0.0), 1.0)
    side = min(abs(x) / 4.0, 1.0)
    return -0.55 + 0.85 * back * back * (3 - 2 * back) + 0.42 * side * side


@cache
def octave_columns(octave: int) -> Columns:
    """The grid's x, in waves of that octave."""
    frequency = 2.0**octave / FIRST_WAVE
    return Columns([(i * CELL + 40.0) * frequency for i in range(COLUMNS + 1)])


def fractal_row(y: float) -> list[float]:
    """Eroded fractal noise along the row at y kilometres."""
    count = COLUMNS + 1
    total, slope_x, slope_y = [0.0] * count, [0.0] * count, [0.0] * count
    for octave in range(OCTAVES):
        frequency = 2.0**octave / FIRST_WAVE
        gain = 0.5**octave
        noise = row_with_slopes(octave_columns(octave), (y + 17.0) * frequency, octave)
        if octave in RIDGED:
            noise = [(0.35 - 1.6 * abs(n), 0.0, 0.0) for n, _, _ in noise]
        slope_x = [s + a for s, (_, a, _) in zip(slope_x, noise, strict=True)]
        slope_y = [s + b for s, (_, _, b) in zip(slope_y, noise, strict=True)]
        total = [
            t + gain * n / (1.0 + 0.35 * (a * a + b * b))
            for t, (n, _, _), a, b in zip(total, noise, slope_x, slope_y, strict=True)
        ]
    return total


@cache
def heights() -> list[list[float]]:
    """Of the grid's points, row by row from near to far, in kilometres."""
    rows = []
    for j in range(ROWS + 1):
        z = -j * CELL
        noise = fractal_row(-z)
        rows.append(
            [
                max(PEAK * n + base(i * CELL - WIDTH / 2, z), WATER - 0.01)
                for i, n in enumerate(noise)
            ]
        )
    return rows


def obj_lines() -> Iterator[str]:
    """The OBJ file: four-cornered faces, counter-clockwise seen from above."""
    yield "# Terrain, 1,000,000 triangles; written by scenes/make_meshes.py\n"
    xs = [f"v {i * CELL - WIDTH / 2:.3f} " for i in range(COLUMNS + 1)]
    for j, line in enumerate(heights()):
        end = f" {-j * CELL:.3f}\n"
        yield "".join([f"{x}{h:.4f}{end}" for x, h in zip(xs, line, strict=True)])
    us = [f"vt {(i + 0.5) / (COLUMNS + 1):.5f} " for i in range(COLUMNS + 1)]
    for j in range(ROWS + 1):
        end = f"{(j + 0.5) / (ROWS + 1):.5f}\n"
        yield "".join([u + end for u in us])
    names = [f"{i}/{i}" for i in range(1, (COLUMNS + 1) * (ROWS + 1) + 1)]
    for j in range(ROWS):
        near = names[j * (COLUMNS + 1) : (j + 1) * (COLUMNS + 1)]
        far = names[(j + 1) * (COLUMNS + 1) : (j + 2) * (COLUMNS + 1)]
        yield "".join(
            [
                f"f {a} {b} {c} {d}\n"
                for a, b, c, d in zip(near, near[1:], far[1:], far, strict=False)
            ]
        )


# Colours ---------------------------------------------------------------------------------------

GRASS, FOREST, ROCK, SCREE, SNOW, SAND = (
    (0.10, 0.135, 0.045),
    (0.035, 0.06, 0.022),
    (0.21, 0.185, 0.16),
    (0.30, 0.265, 0.225),
    (0.86, 0.88, 0.92),
    (0.34, 0.29, 0.21),
)


def mix(a: Color, b: Color, share: float) -> Color:
    """From a to b as share goes from 0 to 1, and not beyond."""
    s = min(max(share, 0.0), 1.0)
    return (a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1]), a[2] + s * (b[2] - a[2]))


def ground(height: float, steepness: float, noise: float) -> Color:
    """What grows or lies there; steepness is rise over run."""
    above = height - WATER
    soil = mix(GRASS, FOREST, 0.5 + 2.0 * noise - 1.2 * (above - 0.35))
    stone = mix(ROCK, SCREE, 0.4 + 1.8 * noise)
    color = mix(soil, stone, (steepness - 0.78 + 0.8 * (above - 0.4) + 0.6 * noise) * 4.0)
    color = mix(SAND, color, (above - 0.012 + 0.02 * noise) * 60.0)
    snow = (above - 0.48 + 0.35 * noise) * 5.0 - max(steepness - 0.85, 0.0) * 3.0
    return mix(color, SNOW, snow)


def color_rows() -> Iterator[list[Color]]:
    """The texture: a texel for each point of the grid, the far row first."""
    grid = heights()
    columns = Columns([i * CELL * 9.0 for i in range(COLUMNS + 1)])
    for j in range(ROWS, -1, -1):
        before, after = grid[max(j - 1, 0)], grid[min(j + 1, ROWS)]
        fine = row(columns, j * CELL * 9.0, 50)
        yield ground_row(grid[j], before, after, fine)


def ground_row(
    here: Sequence[float], before: Sequence[float], after: Sequence[float], fine: Sequence[float]
) -> list[Color]:
    """One row of the texture from the heights about it."""
    east, west = [*here[1:], here[-1]], [here[0], *here[:-1]]
    return [
        ground(h, math.hypot(e - w, a - b) / (2 * CELL), n)
        for h, e, w, a, b, n in zip(here, east, west, after, before, fine, strict=True)
    ]
