"""Every alternative passes, and every mistake fails exactly what its label announces.

With the grader's own checks, in the box; pictures take minutes and are left to `museum --images`.
"""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path

import pytest
from rich.console import Console

from raybook_grader.course import ImageCheck, load_course
from raybook_grader.errors import BadInput
from raybook_grader.museum import Exhibit, exhibits_of
from raybook_grader.museum.label import split_mistake
from raybook_grader.museum.visit import Visit, Visitor, visit_all, with_museum

ROOT = Path(__file__).resolve().parents[3]
VISITOR = Visitor(ROOT, ROOT / "build" / "kit", images=False)
ASSIGNMENTS = {a.number: a for a in with_museum(load_course(ROOT))}
EXHIBITS = {e.name: e for a in ASSIGNMENTS.values() for e in exhibits_of(ROOT, a)}
FEW = ("06", "07")
"""Assignments so small that five mistakes say it all."""


@pytest.fixture(scope="module")
def visits() -> dict[str, Visit]:
    cores = len(os.sched_getaffinity(0))
    return visit_all(VISITOR, list(EXHIBITS.values()), cores, Console(stderr=True))


@pytest.mark.parametrize("name", EXHIBITS)
def test_what_fails_is_what_the_label_announces(name: str, visits: dict[str, Visit]) -> None:
    visit = visits[name]
    assert visit.result.traceback == ""
    told = "\n".join(f"{c.name}: {c.status}: {c.told}" for c in visit.result.checks)
    assert visit.failed == visit.announced, told


@pytest.mark.parametrize("number", ASSIGNMENTS)
def test_the_museum_is_large_enough(number: str) -> None:
    exhibits = [e for e in EXHIBITS.values() if e.assignment == number]
    assert sum(e.is_right for e in exhibits) >= 1 + 4
    assert sum(not e.is_right for e in exhibits) >= (5 if number in FEW else 8)


@pytest.mark.parametrize("number", ASSIGNMENTS)
def test_a_hidden_check_sees_every_mistake(number: str, visits: dict[str, Visit]) -> None:
    pictures = {c.name for c in ASSIGNMENTS[number].checks if isinstance(c, ImageCheck)}
    for visit in visits.values():
        label = visit.exhibit.label
        if visit.exhibit.assignment == number and label is not None:
            seen = (visit.failed - visit.public) | (set(label.expect) & pictures)
            assert seen, visit.exhibit.name


@pytest.mark.parametrize("number", ASSIGNMENTS)
def test_public_tests_do_not_give_the_answer_away(number: str, visits: dict[str, Visit]) -> None:
    wrong = [v for v in visits.values() if v.exhibit.assignment == number and not _right(v)]
    assert any(v.public for v in wrong), "the public tests catch nothing"
    assert any(not v.public for v in wrong), "the public tests catch everything"


def _right(visit: Visit) -> bool:
    return visit.exhibit.is_right


# --- Labels -----------------------------------------------------------------------------------

LABEL = "What: a\nSeen: b\nExpect: c; d\nHint: e\n\n--- a/src/x.c\n+++ b/src/x.c\n"


def test_a_label_is_read(tmp_path: Path) -> None:
    file = tmp_path / "x.patch"
    file.write_text(LABEL)
    label, diff = split_mistake(file)
    assert (label.what, label.seen, label.expect, label.hint) == ("a", "b", ("c", "d"), "e")
    assert diff.startswith("--- a/src/x.c")


@pytest.mark.parametrize(
    "old, new, message",
    [
        ("What: a\n", "", "expected What, Seen, Expect, Hint"),
        ("Hint: e", "Hint e", "expected a line like"),
        ("Seen: b", "Seen: ", "expected a line like"),
        ("--- a/", "*** a/", "no diff after the header"),
        ("\n\n", "\n", "expected"),
    ],
)
def test_a_bad_label_is_refused(tmp_path: Path, old: str, new: str, message: str) -> None:
    file = tmp_path / "x.patch"
    file.write_text(LABEL.replace(old, new))
    with pytest.raises(BadInput, match=message):
        split_mistake(file)


def test_a_patch_that_no_longer_applies_is_refused(tmp_path: Path) -> None:
    assignment = ASSIGNMENTS["01"]
    for kind in ("alternatives", "mistakes"):
        (tmp_path / kind).mkdir()
    text = (assignment.folder / "mistakes" / "open-seams.patch").read_text()
    (tmp_path / "mistakes" / "old.patch").write_text(text.replace(" bool ", " int "))
    with pytest.raises(BadInput, match="no longer applies"):
        exhibits_of(ROOT, replace(assignment, folder=tmp_path))


def test_an_exhibit_is_a_whole_module() -> None:
    for exhibit in EXHIBITS.values():
        assert isinstance(exhibit, Exhibit)
        assert set(exhibit.files) == set(ASSIGNMENTS[exhibit.assignment].owned)
