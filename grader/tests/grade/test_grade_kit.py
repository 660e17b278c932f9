"""A kit that is made anew beneath a run: nothing that was graded with it counts, and nobody loses
points by it.
"""

from __future__ import annotations

import importlib.util
import shutil
from dataclasses import replace
from pathlib import Path

import pytest
from make_class import CHECKOUT, OWNED, solution
from small_course import small_course

from raybook_grader.checks.program import Workshop
from raybook_grader.course import load_course
from raybook_grader.grading import job as job_module
from raybook_grader.grading.job import Job, Worker
from raybook_grader.grading.key import Keys
from raybook_grader.kit import load_kit
from raybook_grader.scoring import Verdict
from raybook_grader.submissions import SubmittedFile


@pytest.fixture
def worker(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Worker:
    """A small course with a kit of its own, and no mistakes to compare with."""
    monkeypatch.setattr(job_module, "load_known", lambda file: ())
    shutil.copytree(CHECKOUT / "build" / "kit", tmp_path / "kit")
    return Worker(small_course(tmp_path / "course"), tmp_path / "kit")


def job_of(worker: Worker) -> Job:
    files = {OWNED: SubmittedFile(solution().encode())}
    course = load_course(worker.root)
    key = Keys(course, load_kit(worker.kit)).key(course.assignment("01"), files)
    return Job(key, "01", files)


def make_anew(kit: Path) -> None:
    """What `make kit` does with a kit that is not the same."""
    shutil.copytree(kit, kit.with_name("fresh"))
    kit.rename(kit.with_name("old"))
    kit.with_name("fresh").rename(kit)


def test_the_same_kit_is_graded_with(worker: Worker) -> None:
    assert worker()(job_of(worker)).verdict is Verdict.PASS


def test_a_kit_replaced_between_two_links(worker: Worker, monkeypatch: pytest.MonkeyPatch) -> None:
    """Half of the objects are gone when the module is linked: no build error of the student's."""
    grade, job = worker(), job_of(worker)
    link = Workshop._link

    def replaced(shop: Workshop, *arguments: object, **named: object) -> bytes:
        for path in sorted((worker.kit / "objects").rglob("*.o"))[::2]:
            path.unlink()
        make_anew(worker.kit)
        return link(shop, *arguments, **named)  # type: ignore[arg-type]

    monkeypatch.setattr(Workshop, "_link", replaced)
    result = grade(job)
    assert result.verdict is Verdict.INTERNAL_ERROR and result.score is None
    assert "not your doing" in result.message


def test_a_kit_replaced_after_the_work_was_planned(worker: Worker) -> None:
    job = job_of(worker)
    text = (worker.kit / "kit.json").read_text()
    (worker.kit / "kit.json").write_text(text + "\n")
    assert worker()(job).verdict is Verdict.INTERNAL_ERROR


def test_a_job_of_other_files(worker: Worker) -> None:
    assert worker()(replace(job_of(worker), key="0" * 64)).verdict is Verdict.INTERNAL_ERROR


def test_make_kit_leaves_what_is_the_same(tmp_path: Path) -> None:
    spec = importlib.util.spec_from_file_location("make_kit", CHECKOUT / "grader" / "make_kit.py")
    assert spec and spec.loader
    make_kit = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(make_kit)
    out = tmp_path / "kit"
    for content, same in (("a", False), ("a", True), ("b", False)):
        fresh = tmp_path / "fresh"
        (fresh / "objects").mkdir(parents=True)
        (fresh / "objects" / "x.o").write_text(content)
        before = out.stat().st_ino if out.exists() else 0
        make_kit.put_in_place(fresh, out)
        assert (out.stat().st_ino == before) is same
        assert (out / "objects" / "x.o").read_text() == content
        assert [path.name for path in tmp_path.iterdir()] == ["kit"]
