"""One look of two rows of `make judge-table`: wrong by 2 % fails, noisy and right does not."""

from __future__ import annotations

import json

import pytest
from judge_table import CHECKOUT, TABLE, Row, Table, brighter

LAMPS = {row.name: row for row in TABLE if "several-lights" in row.scene}


def test_a_bias_fails() -> None:
    said = Table().judge(LAMPS["every light +2 %"], look=0)
    assert said.bias.status == "fail"
    assert "2.0 % too bright" in said.bias.reasons[0].sentence


def test_noise_does_not_fail() -> None:
    said = Table().judge(LAMPS["samples fall anywhere, not in strata"], look=0)
    assert said.bias.status == "pass"
    assert said.bias.noise_ratio is not None
    assert said.bias.noise_ratio > 2, "these pictures should be the noisier ones"


@pytest.mark.parametrize("row", [row for row in TABLE if row.biased], ids=lambda row: row.scene)
def test_all_that_shines_shines_more(row: Row) -> None:
    scene = json.loads((CHECKOUT / row.scene).read_text(encoding="utf-8"))
    changed = brighter(scene)
    assert _emitted(changed) == pytest.approx(1.02 * _emitted(scene)) != 0


def _emitted(value: object, key: str = "") -> float:
    """The sum of all numbers that say how much light there is."""
    if isinstance(value, dict):
        return sum(_emitted(item, name) for name, item in value.items())
    if isinstance(value, list):
        return sum(_emitted(item, key) for item in value)
    shines = key in ("flux", "intensity", "radiance", "scale")
    return float(value) if shines and isinstance(value, (int, float)) else 0.0
