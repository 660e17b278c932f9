"""Grading on a Slurm cluster by one command, from a login node:

    python -m raybook_grader.jobs.slurm --workers 64 -- grade SUBMISSIONS --out DIR

starts a scheduler here, submits Slurm jobs with workers, runs `raybook-grader grade` with that
scheduler, and cancels the jobs when it ends. docs/instructor/cluster.md says what must be in place.
"""

from __future__ import annotations

import argparse
import math
import os
import shlex
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from ..errors import BadInput
from .tls import tls_environment

GIB_PER_WORKER = 3
"""A box has 2 GiB at most for what a student wrote; the grader itself has references in memory."""
_ONE_THREAD = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
_PROTOCOL = "tls://"


@dataclass(frozen=True)
class Order:
    """What Slurm is asked for: ``workers`` in all, ``per_job`` of them, each with a core, a job."""

    workers: int
    per_job: int
    walltime: str
    partition: str | None
    account: str | None
    interface: str | None
    scratch: str
    logs: Path

    @property
    def jobs(self) -> int:
        return math.ceil(self.workers / self.per_job)

    def settings(self) -> dict[str, Any]:
        """For dask_jobqueue."""
        return {
            "cores": self.per_job,
            "processes": self.per_job,
            "memory": f"{GIB_PER_WORKER * self.per_job}GiB",
            "walltime": self.walltime,
            "queue": self.partition,
            "account": self.account,
            "interface": self.interface,
            "local_directory": self.scratch,
            "log_directory": str(self.logs),
            "job_name": "raybook",
            "python": shlex.quote(sys.executable),
            "protocol": _PROTOCOL,
            "job_script_prologue": [f"export {name}=1" for name in _ONE_THREAD],
            "worker_extra_args": ["--no-dashboard"],
            "config_name": "slurm",
        }


def job_script(order: Order, scheduler: str) -> str:
    """The script that Slurm is given, by the scheduler's address."""
    from dask_jobqueue.slurm import SLURMJob
    from distributed import Security

    job = SLURMJob(scheduler=scheduler, name="raybook", security=Security(), **order.settings())
    return str(job.job_script())


def grade(order: Order, arguments: Sequence[str]) -> int:
    """Run `raybook-grader` with these arguments on the cluster; its exit code."""
    from dask_jobqueue.slurm import SLURMCluster
    from distributed import Security

    where = {"interface": order.interface} if order.interface else {}
    options = {"dashboard": False, **where}
    with SLURMCluster(
        **order.settings(), security=Security(), scheduler_options=options
    ) as cluster:
        cluster.scale(jobs=order.jobs)
        print(f"scheduler: {cluster.scheduler_address}; {order.jobs} Slurm jobs", flush=True)
        command = [sys.executable, "-m", "raybook_grader", *arguments]
        return subprocess.call([*command, "--scheduler", cluster.scheduler_address])


def main(arguments: Sequence[str]) -> int:
    """The command line."""
    own = list(arguments)
    rest = own[own.index("--") + 1 :] if "--" in own else []
    parsed = _parser().parse_args(own[: own.index("--")] if "--" in own else own)
    order = Order(
        workers=parsed.workers,
        per_job=min(parsed.per_job, parsed.workers),
        walltime=parsed.walltime,
        partition=parsed.partition,
        account=parsed.account,
        interface=parsed.interface,
        scratch=parsed.scratch,
        logs=parsed.logs,
    )
    try:
        if find_spec("dask_jobqueue") is None:
            raise BadInput("needs the Python package 'dask-jobqueue', which is not installed")
        if rest[:1] != ["grade"] and not parsed.script:
            raise BadInput("expected `-- grade SUBMISSIONS --out DIR` at the end")
        with tempfile.TemporaryDirectory(prefix=".raybook-tls-", dir=Path.home()) as keys:
            # Before Dask is imported: it reads its configuration then.
            os.environ.update(tls_environment(Path(keys)))
            if parsed.script:
                print(job_script(order, f"{_PROTOCOL}SCHEDULER:8786"), end="")
                return 0
            return grade(order, rest)
    except BadInput as fault:
        print(f"raybook slurm: {fault}", file=sys.stderr)
        return 2


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="python -m raybook_grader.jobs.slurm",
        description="Grades a class on a Slurm cluster.",
        usage="%(prog)s [options] -- grade SUBMISSIONS --out DIR [...]",
    )
    parser.add_argument("--workers", type=int, default=32, help="in all (default: %(default)s)")
    parser.add_argument(
        "--per-job", type=int, default=8, help="workers a Slurm job, a core each (default: 8)"
    )
    parser.add_argument("--walltime", default="02:00:00", help="of a job (default: %(default)s)")
    parser.add_argument("--partition", help="Slurm's partition")
    parser.add_argument("--account", help="Slurm's account")
    parser.add_argument("--interface", help="the network between the nodes, such as ib0")
    parser.add_argument(
        "--scratch", default="/tmp", help="a folder on each node's own disk (default: %(default)s)"
    )
    parser.add_argument(
        "--logs",
        type=Path,
        default=Path("raybook-slurm"),
        help="of the jobs (default: %(default)s)",
    )
    parser.add_argument("--script", action="store_true", help="print the job's script and stop")
    return parser


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
