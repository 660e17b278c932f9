"""A few kills at random moments; `make kill-table` does 200."""

from __future__ import annotations

from pathlib import Path

from kill_table import make_table


def test_kills_at_random_moments(tmp_path: Path) -> None:
    table = make_table(tmp_path, kills=10, seed=11)
    assert table.total == 10, str(table)
