"""Sampling by importance beside sampling evenly: group `sampling`, measured by variance.py."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from dataclasses import replace

from bench_effort import Effort
from bench_programs import HERE
from bench_rows import Row

sys.path.insert(0, str(HERE.parent / "renderer"))

import variance
import variance_rows
from renderer_runs import Json

SUNNY_SKY: Json = {**variance_rows.MIDDLES, **variance_rows.RANDOM, "integrator": {
    "type": "path", "max_depth": 1, "rr_threshold": 0, "light_selection": "all"}}  # fmt: skip

SUNNY = variance_rows.Row(
    variance_rows.SKY,
    variance_rows.EVEN_SKY,
    "sunny-sky.json",
    50,
    variance_rows.SUNNY,
    SUNNY_SKY,
    resolution=(75, 60),
)
"""The demo scene's sky, whose sun is as small and as bright as the real one."""

POWER = variance_rows.selection("power")
QUICK_SEEDS, FULL_SEEDS = 8, 24


def sampling_rows(effort: Effort) -> Iterator[Row]:
    """Variance at equal samples, the plain way's over the better one's."""
    variance.prepare()
    seeds = FULL_SEEDS if effort.long_rows else QUICK_SEEDS
    yield _row(variance.measure(SUNNY, seeds))
    for row in variance_rows.ROWS:
        if effort.long_rows:
            yield _row(variance.measure(row, seeds))
        elif row.better == POWER:
            yield _row(variance.measure(variance.quick(row), seeds))


def _row(found: variance.Measured) -> Row:
    row = Row(
        "sampling",
        found.row.better.name,
        found.row.scene.removesuffix(".json"),
        "at equal work" if found.row.at_equal_work else "at equal samples",
        found.row.plain.name,
        figure=found.better,
        unit="variance",
        ratio=found.figure,
        low=found.figure * (1 - found.error / found.ratio),
        high=found.figure * (1 + found.error / found.ratio),
    )
    return replace(row, note=f"{found.row.spp} samples a pixel; must beat {found.row.must_beat:g}")
