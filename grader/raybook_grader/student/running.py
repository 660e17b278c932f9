"""Running a program of the student's, with an end."""

from __future__ import annotations

import math
import os
import resource
import signal
import subprocess
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

# Processor time is what a module spends, whatever else the machine does; real time only stops
# programs that wait for ever.
_PATIENCE = 6.0


@dataclass(frozen=True)
class Ended:
    """``code`` is the exit code, negative for a signal; None if the program was stopped."""

    code: int | None
    out: bytes
    err: bytes


def run_limited(command: Sequence[str], root: Path, seconds: float, threads: int = 1) -> Ended:
    """Run a program that may take ``seconds`` of processor time on each of its threads."""
    limit = math.ceil(seconds * threads)

    def limit_time() -> None:
        resource.setrlimit(resource.RLIMIT_CPU, (limit, limit + 1))

    try:
        done = subprocess.run(
            command,
            cwd=root,
            capture_output=True,
            timeout=_PATIENCE * seconds,
            preexec_fn=limit_time,
        )
    except subprocess.TimeoutExpired as late:
        return Ended(None, late.stdout or b"", late.stderr or b"")
    code = None if done.returncode == -signal.SIGXCPU else done.returncode
    return Ended(code, done.stdout, done.stderr)


def all_threads() -> int:
    """As many as the renderer takes by itself."""
    return os.cpu_count() or 1
