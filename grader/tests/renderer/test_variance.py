"""Every sampling method lowers the variance: a quick version of variance.py's table.

The seeds are fixed. What is asked is half of what the table asks (on few pixels and seeds a figure
is known to some tens of per cent, and the most are ten times what they must be).
"""

from __future__ import annotations

from dataclasses import replace

import pytest
from variance import Measured, line_of, measure, prepare, quick
from variance_rows import ROWS, Row

SEEDS = 8


@pytest.fixture(scope="module", autouse=True)
def scenes() -> None:
    prepare()


def measured(row: Row) -> Measured:
    return measure(quick(row), SEEDS)


def name(row: Row) -> str:
    return f"{row.better.name}, {row.plain.name}, {row.scene}"


@pytest.mark.parametrize("row", [r for r in ROWS if not r.at_equal_work], ids=name)
def test_it_lowers_the_variance(row: Row) -> None:
    found = measured(row)
    assert found.ratio > max(1.5, row.must_beat / 2), line_of(found)


def test_roulette_saves_work_and_costs_little_variance() -> None:
    (row,) = [r for r in ROWS if r.at_equal_work]
    found = measured(row)
    assert found.rays < 0.75
    assert found.figure > 0.8, line_of(found)


def test_the_plain_way_does_not_beat_the_better_one() -> None:
    """The measurement tells the two apart."""
    row = replace(ROWS[0], better=ROWS[0].plain, plain=ROWS[0].better)
    assert not measured(row).fine
    assert measured(row).ratio < 0.5
