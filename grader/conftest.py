"""What `make test` leaves to RAYBOOK_FULL=1: the right modules by other compilers and other seeds.

The museum judges all of them once, as the grader does; here it is about margins.
"""

from __future__ import annotations

import os
from pathlib import Path

import pytest

_HERE = Path(__file__).parent / "tests" / "assignments"

_OTHER_SEEDS = ("other_seeds", "another_seed")
_OTHER_COMPILERS = ("-gcc--O0]", "-clang--O2]")
_SLOW = ("test_small_faults_are_found[asks for ever]",)


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    if "RAYBOOK_FULL" in os.environ:
        return
    later = [item for item in items if _is_for_later(item)]
    config.hook.pytest_deselected(items=later)
    items[:] = [item for item in items if not _is_for_later(item)]


def _is_for_later(item: pytest.Item) -> bool:
    if not item.path.is_relative_to(_HERE):
        return False
    others = any(word in item.name for word in _OTHER_SEEDS)
    return others or item.name.endswith((*_OTHER_COMPILERS, *_SLOW))
