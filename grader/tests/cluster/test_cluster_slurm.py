"""The Slurm recipe: its job script, and a whole run with commands in place of Slurm's own."""

from __future__ import annotations

import os
import stat
import subprocess
import sys
from pathlib import Path

import pytest
from local_cluster import LocalCluster

from raybook_grader.jobs.tls import tls_environment

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "grade"))
from make_class import OWNED, solution
from small_course import grades, small_course, write_submissions

SLURM = (sys.executable, "-m", "raybook_grader.jobs.slurm")
SBATCH = """#!/bin/sh
cp "$1" "$LOGS/job.sh" # as Slurm does: dask-jobqueue removes its file
setsid bash "$LOGS/job.sh" > "$LOGS/job.log" 2>&1 &
echo "Submitted batch job $!"
"""
SCANCEL = """#!/bin/sh
for job; do echo "$job" >> "$LOGS/cancelled"; kill -9 -- "-$job"; done
"""


def test_the_job_script(tmp_path: Path) -> None:
    options = ("--workers", "20", "--per-job", "4", "--partition", "cpu", "--account", "cs")
    ended = subprocess.run([*SLURM, "--script", *options], capture_output=True, text=True)
    assert ended.returncode == 0, ended.stderr
    script = ended.stdout
    assert subprocess.run(["bash", "-n"], input=script, text=True).returncode == 0
    directives = [line for line in script.splitlines() if line.startswith("#SBATCH")]
    for expected in ("-p cpu", "-A cs", "--cpus-per-task=4", "--mem=12G", "-t 02:00:00"):
        assert f"#SBATCH {expected}" in directives
    worker = script.splitlines()[-1]
    for expected in ("--nthreads 1", "--nworkers 4", "tls://SCHEDULER:8786", "--tls-key "):
        assert expected in worker
    assert script.index("export OMP_NUM_THREADS=1") < script.index(worker)


@pytest.mark.parametrize("rest", [(), ("--",), ("--", "report", "build/grades")])
def test_it_grades_and_nothing_else(rest: tuple[str, ...]) -> None:
    ended = subprocess.run([*SLURM, *rest], capture_output=True, text=True)
    assert ended.returncode == 2
    assert "expected `-- grade SUBMISSIONS --out DIR`" in ended.stderr


def test_a_run_from_submission_to_cancelling(tmp_path: Path) -> None:
    texts = {f"s{i}": f"{solution()}/* {i} */\n" for i in range(2)}
    submissions = write_submissions(tmp_path / "submissions", texts, OWNED)
    course = small_course(tmp_path / "course")
    ended = subprocess.run(
        [*SLURM, "--workers", "1", "--interface", "lo", "--scratch", str(tmp_path),
         "--logs", str(tmp_path), "--",
         "grade", str(submissions), "--out", str(tmp_path / "out"), "--course", str(course)],
        capture_output=True, text=True, env=_with_slurm(tmp_path), cwd=tmp_path,
        timeout=600,
    )  # fmt: skip
    log = tmp_path / "job.log"
    assert ended.returncode == 0, ended.stdout + ended.stderr + log.read_text()
    assert "cluster: 1 workers, 2 jobs done" in ended.stdout
    assert [s["score"] for s in grades(tmp_path / "out").values()] == [8, 8]
    assert (tmp_path / "cancelled").read_text().strip()


def _with_slurm(folder: Path) -> dict[str, str]:
    for name, text in (("sbatch", SBATCH), ("scancel", SCANCEL)):
        (folder / name).write_text(text)
        (folder / name).chmod(0o755)
    return {**os.environ, "PATH": f"{folder}:{os.environ['PATH']}", "LOGS": str(folder)}


def test_nobody_joins_without_the_key(tmp_path: Path) -> None:
    ours = tls_environment(tmp_path / "keys")
    assert {stat.S_IMODE(p.stat().st_mode) for p in (tmp_path / "keys").iterdir()} == {0o600}
    others = tls_environment(tmp_path / "others")
    with LocalCluster(tmp_path / "cluster", ours, "tls://") as cluster:
        for keys in ({}, others):
            assert "no scheduler answers" in _meet(cluster.address, keys)
        assert _meet(cluster.address, ours) == ""
        plain = cluster.address.replace("tls:", "tcp:")
        assert "no scheduler answers" in _meet(plain, {})


def _meet(address: str, keys: dict[str, str]) -> str:
    """What a program with these keys is told at an address; "" if it is let in."""
    program = (
        "import sys\n"
        "from raybook_grader.errors import BadInput\n"
        "from raybook_grader.jobs import dask_client\n"
        "dask_client._CONNECT_SECONDS = 3\n"
        "try:\n"
        "    dask_client.connect(sys.argv[1]).close()\n"
        "except BadInput as fault:\n"
        "    print(fault)\n"
    )
    ended = subprocess.run(
        [sys.executable, "-c", program, address],
        capture_output=True, text=True, env={**os.environ, **keys},
    )  # fmt: skip
    assert ended.returncode == 0, ended.stderr
    return ended.stdout
