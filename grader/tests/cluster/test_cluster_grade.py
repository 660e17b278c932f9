"""`grade --scheduler`: the same grades as on one machine, whoever dies on the way."""

from __future__ import annotations

import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from local_cluster import LocalCluster

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "grade"))
from make_class import OWNED, solution
from small_course import FOLDER, command, done, grades, run, small_course, write_submissions

from raybook_grader.cli import main

STUDENTS = 6


@pytest.fixture(scope="module")
def course(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return small_course(tmp_path_factory.mktemp("course") / "course")


@pytest.fixture(scope="module")
def submissions(tmp_path_factory: pytest.TempPathFactory) -> Path:
    right = solution()
    wrong = f"#define TODO_triangle_uv_differentials\n{right}"
    texts = {f"s{i}": (right if i % 2 else wrong) + f"/* {i} */\n" for i in range(STUDENTS)}
    return write_submissions(tmp_path_factory.mktemp("submissions"), texts, OWNED)


@pytest.fixture(scope="module")
def local(submissions: Path, course: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The results of the local pool."""
    out = tmp_path_factory.mktemp("local") / "out"
    ended = run("grade", submissions, "--out", out, "--course", course)
    assert ended.returncode == 0, ended.stdout + ended.stderr
    return out


def start(
    submissions: Path, out: Path, course: Path, cluster: LocalCluster
) -> subprocess.Popen[str]:
    arguments = ("--out", out, "--course", course, "--scheduler", cluster.address)
    return subprocess.Popen(
        command("grade", submissions, *arguments),
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )


def test_a_worker_dies_and_another_one_joins(
    submissions: Path, course: Path, local: Path, tmp_path: Path
) -> None:
    with LocalCluster(tmp_path / "cluster") as cluster:
        cluster.add_worker()
        cluster.add_worker()
        grading = start(submissions, tmp_path / "out", course, cluster)
        cluster.kill_in_mid_job(0)
        cluster.add_worker()
        said, _ = grading.communicate()
        assert grading.returncode == 0, said + cluster.said()
    assert said.count("another one gets its job") == 1
    assert f"{STUDENTS} jobs done, 1 times a job was lost" in said
    assert (tmp_path / "out" / "grades.json").read_bytes() == (local / "grades.json").read_bytes()
    assert len(done(tmp_path / "out")) == STUDENTS


def test_the_scheduler_dies_and_the_rest_is_graded_here(
    submissions: Path, course: Path, local: Path, tmp_path: Path
) -> None:
    out = tmp_path / "out"
    with LocalCluster(tmp_path / "cluster") as cluster:
        cluster.add_worker()
        grading = start(submissions, out, course, cluster)
        while len(done(out)) < 2:
            assert grading.poll() is None, cluster.said()
            time.sleep(0.02)
        cluster.kill_scheduler()
        said, _ = grading.communicate()
    assert grading.returncode == 1
    assert "connection to the scheduler is lost" in said
    assert "Go on with the same command" in said
    assert "Traceback" not in said, said
    before = done(out)
    assert 2 <= len(before) < STUDENTS
    ended = run("grade", submissions, "--out", out, "--course", course)
    assert ended.returncode == 0, ended.stdout + ended.stderr
    after = done(out)
    assert {key: after[key] for key in before} == before
    assert grades(out) == grades(local)


def test_a_worker_with_another_course_gets_no_work(
    submissions: Path, course: Path, local: Path, tmp_path: Path
) -> None:
    other = small_course(tmp_path / "other")
    rubric = other / FOLDER / "assignment.toml"
    rubric.write_text(rubric.read_text() + "\n# Somebody's own\n")
    with LocalCluster(tmp_path / "cluster") as cluster:
        cluster.add_worker({"RAYBOOK_COURSE": str(other)})
        said, _ = (grading := start(submissions, tmp_path / "out", course, cluster)).communicate()
    assert grading.returncode == 1, said
    assert "another text of assignment 01" in said
    assert "Traceback" not in said, said
    assert not done(tmp_path / "out")


def test_stopped_while_it_waits_for_workers(
    submissions: Path, course: Path, local: Path, tmp_path: Path
) -> None:
    with LocalCluster(tmp_path / "cluster") as cluster:
        grading = start(submissions, tmp_path / "out", course, cluster)
        assert grading.stdout is not None
        for line in grading.stdout:
            if "no workers yet" in line:
                break
        grading.send_signal(signal.SIGINT)
        said, _ = grading.communicate()
    assert grading.returncode == 130, said
    assert "Go on with the same command" in said
    assert "Traceback" not in said


def test_nobody_at_the_address(
    submissions: Path,
    course: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    arguments = ("--out", tmp_path / "out", "--course", course, "--scheduler", "tcp://127.0.0.1:1")
    monkeypatch.setattr(
        sys, "argv", ["raybook-grader", "grade", *map(str, (submissions, *arguments))]
    )
    assert main() == 2
    assert "no scheduler answers" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()
