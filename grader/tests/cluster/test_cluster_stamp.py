"""What must be the same on every machine, and what is said when it is not."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from raybook_grader.course import load_course
from raybook_grader.errors import BadInput
from raybook_grader.grading import remote
from raybook_grader.grading.job import Worker
from raybook_grader.grading.key import Keys
from raybook_grader.grading.remote import RemoteWorker
from raybook_grader.grading.stamp import Stamp, stamp
from raybook_grader.kit import load_kit

CHECKOUT = Path(__file__).resolve().parents[3]
OURS = Stamp("grader", "kit", "processor", (("01", "a"), ("03", "b")))


def test_the_same_checkout_has_the_same_stamp() -> None:
    kit, course = load_kit(CHECKOUT / "build" / "kit"), load_course(CHECKOUT)
    first, second = (stamp(Keys(course, kit), kit, course.assignments[:2]) for _ in range(2))
    assert first == second
    assert first.difference(second) == ""
    assert (first.processor == "") == ("-march=native" not in kit.cflags)


@pytest.mark.parametrize(
    ("theirs", "words"),
    [
        (replace(OURS, grader="x", kit="y"), "another version of the grader"),
        (replace(OURS, kit="x"), "another kit or compiler"),
        (replace(OURS, processor="x"), "make kit ARCH="),
        (replace(OURS, assignments=(("01", "a"), ("03", "x"))), "another text of assignment 03"),
        (replace(OURS, assignments=(("01", "a"),)), "another text of assignment 03"),
    ],
)
def test_a_difference_is_told(theirs: Stamp, words: str) -> None:
    assert words in OURS.difference(theirs)


def test_what_is_not_made_ready_is_told(tmp_path: Path) -> None:
    """A copied checkout without build/diagnosis."""
    other = tmp_path / "course"
    other.mkdir()
    for shared in ("src", "scenes", "assignments", "grader"):
        (other / shared).symlink_to(CHECKOUT / shared)
    (other / "build").mkdir()
    (other / "build" / "kit").symlink_to(CHECKOUT / "build" / "kit")
    worker = RemoteWorker.of(Worker(other, other / "build" / "kit"), {"01"})
    with pytest.raises(BadInput, match=r"lacks.*copy build/reference and build/diagnosis"):
        worker()


def test_a_worker_older_than_its_files_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(remote, "_AT_START", "what it was started from")
    worker = RemoteWorker.of(Worker(CHECKOUT, CHECKOUT / "build" / "kit"), set())
    with pytest.raises(BadInput, match="changed since this worker was started"):
        worker()


def test_no_cluster_without_the_sandbox() -> None:
    with pytest.raises(BadInput, match="--unsafe is for this machine alone"):
        RemoteWorker.of(Worker(CHECKOUT, CHECKOUT / "build" / "kit", unsafe=True), {"01"})
