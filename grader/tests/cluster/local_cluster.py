"""A real scheduler and real workers, each a process of its own, on this machine's loopback only."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Mapping
from pathlib import Path
from types import TracebackType
from typing import Self

START_SECONDS = 120.0


class LocalCluster:
    """A scheduler; workers are added one by one. Leaving the `with` ends them all."""

    def __init__(
        self, folder: Path, environment: Mapping[str, str] | None = None, protocol: str = "tcp://"
    ) -> None:
        """``folder`` is new; the scheduler's address and everybody's words go there."""
        folder.mkdir()
        self._folder = folder
        toys = str(Path(__file__).parent)
        self._environment = {**os.environ, "PYTHONPATH": toys, **(environment or {})}
        self._workers: list[subprocess.Popen[bytes]] = []
        file = folder / "scheduler.json"
        self._scheduler = self._start(
            "scheduler", "--host", "127.0.0.1", "--port", "0", "--scheduler-file", file,
            "--protocol", protocol,
        )  # fmt: skip
        deadline = time.monotonic() + START_SECONDS
        while not (file.is_file() and file.stat().st_size):
            assert time.monotonic() < deadline and self._scheduler.poll() is None, self.said()
            time.sleep(0.05)
        self.address = str(json.loads(file.read_text())["address"])

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        for process in (*self._workers, self._scheduler):
            if process.poll() is None:
                os.killpg(process.pid, signal.SIGKILL)
            process.wait()

    def add_worker(self, environment: Mapping[str, str] | None = None, nanny: bool = False) -> int:
        """Start a worker process with one thread; its number. A nanny replaces a dead worker."""
        name = f"worker-{len(self._workers)}"
        worker = self._start(
            "worker", self.address, "--host", "127.0.0.1", "--nthreads", "1", "--memory-limit", "0",
            "--nanny" if nanny else "--no-nanny", "--name", name,
            "--local-directory", self._folder / name, environment=environment,
        )  # fmt: skip
        self._workers.append(worker)
        return len(self._workers) - 1

    def kill_in_mid_job(self, number: int) -> None:
        """SIGKILL a worker while it runs something in a box."""
        self.wait_for_a_job(number)
        worker = self._workers[number]
        worker.kill()
        worker.wait()

    def wait_for_a_job(self, number: int) -> None:
        """Come back while a worker runs something in a box."""
        worker = self._workers[number]
        deadline = time.monotonic() + START_SECONDS
        while not is_in_a_box(worker.pid):
            assert time.monotonic() < deadline and worker.poll() is None, self.said()
            time.sleep(0.005)

    @property
    def scheduler_pid(self) -> int:
        return self._scheduler.pid

    def kill_scheduler(self) -> None:
        self._scheduler.kill()
        self._scheduler.wait()

    def said(self) -> str:
        """What the scheduler and the workers have said."""
        return "\n".join(log.read_text(errors="replace") for log in self._folder.glob("*.log"))

    def _start(
        self, what: str, *arguments: str | Path, environment: Mapping[str, str] | None = None
    ) -> subprocess.Popen[bytes]:
        program = [sys.executable, "-m", f"distributed.cli.dask_{what}", "--no-dashboard"]
        with (self._folder / f"{what}-{len(self._workers)}.log").open("wb") as log:
            return subprocess.Popen(
                [*program, *map(str, arguments)],
                stdout=log,
                stderr=subprocess.STDOUT,
                env={**self._environment, **(environment or {})},
                start_new_session=True,
            )


def is_in_a_box(pid: int) -> bool:
    """Whether a process has a child that makes or is a box, other than the one for trial."""
    for task in Path(f"/proc/{pid}/task").glob("*/children"):
        for child in task.read_text().split():
            try:
                command = Path(f"/proc/{child}/cmdline").read_bytes()
            except OSError:
                continue
            if b"/supervisor" in command and b"/bin/true" not in command:
                return True
    return False
