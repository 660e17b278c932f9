"""Every check's points have a reason, beside them in `assignment.toml`."""

from __future__ import annotations

from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[3]
RUBRICS = sorted((ROOT / "assignments").glob("*/assignment.toml"))


def reasons(rubric: Path) -> list[str]:
    """The comment right above each check; empty where there is none."""
    lines = rubric.read_text(encoding="utf-8").splitlines()
    found = []
    for place, line in enumerate(lines):
        if line.strip() != "[[check]]":
            continue
        first = place
        while first > 0 and lines[first - 1].startswith("#"):
            first -= 1
        found.append(" ".join(text.lstrip("# ") for text in lines[first:place]))
    return found


@pytest.mark.parametrize("rubric", RUBRICS, ids=lambda rubric: rubric.parent.name)
def test_the_points_of_each_check_have_a_reason(rubric: Path) -> None:
    given = reasons(rubric)
    assert given
    assert all(len(reason.split()) >= 3 for reason in given), given


def test_a_check_without_a_reason_is_found(tmp_path: Path) -> None:
    rubric = tmp_path / "assignment.toml"
    rubric.write_text("# Why it is so.\n[[check]]\npoints = 1\n\n# Of the file.\n\n[[check]]\n")
    assert reasons(rubric) == ["Why it is so.", ""]
