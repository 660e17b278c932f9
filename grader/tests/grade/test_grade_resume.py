"""A run that is killed or stopped goes on where it was; work is never done twice."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import time
from collections.abc import Callable
from pathlib import Path

import pytest
from make_class import OWNED, solution
from small_course import command, done, grades, run, small_course, write_submissions

STUDENTS = 6


@pytest.fixture(scope="module")
def course(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return small_course(tmp_path_factory.mktemp("course") / "course")


@pytest.fixture(scope="module")
def submissions(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """As many different modules as students: half of them right, half of them half done."""
    right = solution()
    wrong = f"#define TODO_triangle_uv_differentials\n{right}"
    texts = {f"s{i}": (right if i % 2 else wrong) + f"/* {i} */\n" for i in range(STUDENTS)}
    return write_submissions(tmp_path_factory.mktemp("submissions"), texts, OWNED)


@pytest.fixture(scope="module")
def whole(submissions: Path, course: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The results of a run that nothing disturbed."""
    out = tmp_path_factory.mktemp("whole") / "out"
    ended = run("grade", submissions, "--out", out, "--course", course)
    assert ended.returncode == 0, ended.stdout + ended.stderr
    return out


def start(submissions: Path, out: Path, course: Path, modules: int) -> subprocess.Popen[str]:
    """Start a run in a session of its own and come back when so many modules are done."""
    process = subprocess.Popen(
        command("grade", submissions, "--out", out, "--course", course, "--jobs", "1"),
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        start_new_session=True,
    )
    while len(done(out)) < modules:
        assert process.poll() is None, process.stdout and process.stdout.read()
        time.sleep(0.02)
    return process


def session(leader: int) -> list[int]:
    """The processes of a session that are still running."""
    found = []
    for entry in Path("/proc").iterdir():
        if entry.name.isdecimal():
            try:
                fields = (entry / "stat").read_text().rpartition(")")[2].split()
            except OSError:
                continue
            if int(fields[3]) == leader and fields[0] != "Z":
                found.append(int(entry.name))
    return found


def finish(submissions: Path, out: Path, course: Path, before: dict[str, int]) -> None:
    """Give the same command again; nothing that was done is done again."""
    ended = run("grade", submissions, "--out", out, "--course", course)
    assert ended.returncode == 0, ended.stdout + ended.stderr
    after = done(out)
    assert len(after) == STUDENTS
    assert {key: after[key] for key in before} == before


@pytest.mark.parametrize("kill", [os.killpg, os.kill], ids=["with its workers", "alone"])
def test_killed_half_way(
    kill: Callable[[int, int], None], submissions: Path, course: Path, whole: Path, tmp_path: Path
) -> None:
    process = start(submissions, tmp_path / "out", course, 3)
    kill(process.pid, signal.SIGKILL)
    process.wait()
    deadline = time.monotonic() + 60
    while session(process.pid) and time.monotonic() < deadline:
        time.sleep(0.02)
    assert not session(process.pid), "a worker outlives the run"
    before = done(tmp_path / "out")
    assert 3 <= len(before) < STUDENTS
    assert not (tmp_path / "out" / "grades.json").exists()
    finish(submissions, tmp_path / "out", course, before)
    assert (tmp_path / "out" / "grades.json").read_bytes() == (whole / "grades.json").read_bytes()


def test_interrupted(submissions: Path, course: Path, whole: Path, tmp_path: Path) -> None:
    process = start(submissions, tmp_path / "out", course, 2)
    os.killpg(process.pid, signal.SIGINT)
    said, _ = process.communicate()
    assert process.returncode == 130
    assert "Go on with the same command" in said
    assert "Traceback" not in said
    finish(submissions, tmp_path / "out", course, done(tmp_path / "out"))
    assert (tmp_path / "out" / "grades.json").read_bytes() == (whole / "grades.json").read_bytes()


def test_the_same_again_does_nothing(submissions: Path, course: Path, whole: Path) -> None:
    before, pages = done(whole), (whole / "index.html").read_bytes()
    ended = run("grade", submissions, "--out", whole, "--course", course)
    assert ended.returncode == 0
    assert "0 modules to grade" in ended.stdout
    assert done(whole) == before
    assert (whole / "index.html").read_bytes() == pages


def test_regrade_does_what_is_named(submissions: Path, course: Path, whole: Path) -> None:
    before = done(whole)
    ended = run("grade", submissions, "--out", whole, "--course", course, "--regrade", "s1,s2")
    assert ended.returncode == 0
    again = [key for key, number in done(whole).items() if before[key] != number]
    assert len(again) == 2
    assert "changed" not in ended.stdout


def test_only_one_run_at_a_time(submissions: Path, course: Path, tmp_path: Path) -> None:
    process = start(submissions, tmp_path / "out", course, 1)
    second = run("grade", submissions, "--out", tmp_path / "out", "--course", course)
    os.killpg(process.pid, signal.SIGKILL)
    process.wait()
    assert second.returncode == 2
    assert "another run" in second.stderr


def test_report_writes_the_same_pages(whole: Path) -> None:
    page = whole / "index.html"
    before = page.read_bytes()
    page.unlink()
    ended = run("report", whole)
    assert ended.returncode == 0
    assert page.read_bytes() == before


def test_equal_work_is_done_once(course: Path, tmp_path: Path) -> None:
    same = {f"twin{i}": solution() for i in range(3)}
    folder = write_submissions(tmp_path / "twins", same, OWNED)
    ended = run("grade", folder, "--out", tmp_path / "out", "--course", course)
    assert ended.returncode == 0
    assert len(done(tmp_path / "out")) == 1
    assert len(grades(tmp_path / "out")) == 3


def test_half_written_files_of_a_killed_run_go(
    submissions: Path, course: Path, whole: Path, tmp_path: Path
) -> None:
    """Wherever pages are written: beside the grades, for each student, for each module."""
    out = tmp_path / "out"
    shutil.copytree(whole, out)
    pages = [out / "index.html", *(out / "students").rglob("*.html")]
    assert {len(page.relative_to(out).parts) for page in pages} == {1, 2, 3}
    for page in pages:
        page.with_name(f".{page.name}.x1y2.part").write_text("half a pa")
    ended = run("grade", submissions, "--out", out, "--course", course)
    assert ended.returncode == 0, ended.stdout + ended.stderr
    assert not list(out.rglob("*.part"))
