"""A machine that cannot make a box: grading is refused, or says everywhere that it was unsafe."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
from pathlib import Path

import pytest
from make_class import OWNED, solution
from small_course import FOLDER, command, grades, run, small_course, write_submissions

_HIDE = 'mount --bind /dev/null "$0" && exec "$@"'


def run_without_bubblewrap(*arguments: str | Path) -> subprocess.CompletedProcess[str]:
    """The real program in a mount namespace of its own, in which bwrap is no program."""
    bwrap = shutil.which("bwrap")
    assert bwrap is not None
    own = [] if os.geteuid() == 0 else ["--map-root-user"]
    hidden = ["unshare", "--mount", *own, "sh", "-c", _HIDE, os.path.realpath(bwrap)]
    return subprocess.run(
        [*hidden, *command(*arguments)], capture_output=True, text=True, check=False
    )


@pytest.fixture
def course(tmp_path: Path) -> Path:
    root = small_course(tmp_path / "course")
    for known in ("mistakes", "alternatives", "twins"):  # no diagnosis: it is not asked for here
        shutil.rmtree(root / FOLDER / known)
    return root


@pytest.fixture
def submissions(tmp_path: Path) -> Path:
    crash = "__attribute__((constructor)) static void end(void) { __builtin_trap(); }\n"
    texts = {"right": solution(), "crashes": solution() + crash, "broken": "int a = ;\n"}
    return write_submissions(tmp_path / "class", texts, OWNED)


def test_without_a_sandbox_grading_is_refused(
    tmp_path: Path, course: Path, submissions: Path
) -> None:
    ended = run_without_bubblewrap(
        "grade", submissions, "--out", tmp_path / "out", "--course", course
    )
    assert ended.returncode == 1
    for word in ("cannot make one", "bwrap is not in PATH", "apt-get install", "--unsafe"):
        assert word in ended.stderr
    assert not (tmp_path / "out").exists()


def test_unsafe_results_say_so_and_are_not_kept(
    tmp_path: Path, course: Path, submissions: Path
) -> None:
    out = tmp_path / "out"
    order = ("grade", submissions, "--out", out, "--course", course)
    ended = run_without_bubblewrap(*order, "--unsafe")
    assert ended.returncode == 0, ended.stdout + ended.stderr
    assert ended.stdout.count("WITHOUT a sandbox") == 1
    assert "these results are unsafe" in ended.stdout.splitlines()[-1]
    assert json.loads((out / "grades.json").read_text())["unsafe"] is True
    found = {name: s["modules"][0] for name, s in grades(out).items()}
    assert all(module["unsafe"] for module in found.values())
    verdicts = {name: module["verdict"] for name, module in found.items()}
    assert verdicts == {"right": "pass", "crashes": "crash", "broken": "build-error"}
    for page in (out / "index.html", *(out / "students").glob("*.html")):
        assert "Unsafe results" in page.read_text()

    again = run(*order, "--unsafe")
    assert again.returncode == 0, again.stdout + again.stderr
    assert "not needed here" in again.stdout and "3 modules to grade" in again.stdout
    assert json.loads((out / "grades.json").read_text())["unsafe"] is False
    assert {name: s["modules"][0]["verdict"] for name, s in grades(out).items()} == verdicts
    assert "Unsafe" not in (out / "index.html").read_text()
