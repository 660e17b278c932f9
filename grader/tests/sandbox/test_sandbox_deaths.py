"""The supervisor or the harness dies: nothing is believed, and nothing lives on."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path

import pytest
from tiny_programs import QUICK, with_package

from raybook_grader.sandbox import Box


def commands() -> Iterator[tuple[int, list[str]]]:
    for entry in Path("/proc").glob("[0-9]*/cmdline"):
        try:
            words = entry.read_bytes().decode("utf-8", "replace").split("\0")
        except OSError:
            continue
        yield int(entry.parent.name), words


def sleepers(mark: str) -> list[int]:
    return [pid for pid, words in commands() if words[:2] == ["sleep", mark]]


def until(true: object, seconds: float = 10) -> bool:
    """Waits for a condition; the time only bounds how long a failure takes."""
    assert callable(true)
    end = time.monotonic() + seconds
    while not true():
        if time.monotonic() > end:
            return False
        time.sleep(0.01)
    return True


def test_a_killed_harness_takes_its_boxes_along() -> None:
    mark = f"600.{os.getpid()}"
    make = "import sys; from raybook_grader.sandbox import Box; Box().run(['sleep', sys.argv[1]])"
    harness = subprocess.Popen([sys.executable, "-c", make, mark], env=with_package())
    try:
        assert until(lambda: sleepers(mark))
    finally:
        harness.send_signal(signal.SIGKILL)
        harness.wait()
    assert until(lambda: not sleepers(mark))


def test_a_harness_under_stricter_limits_still_works() -> None:
    make = (
        "import resource as r, sys\n"
        "from raybook_grader.sandbox import Box\n"
        "r.setrlimit(r.RLIMIT_CORE, (0, 0)); r.setrlimit(r.RLIMIT_NOFILE, (128, 128))\n"
        "sys.exit(not Box().run(['true']).ok)"
    )
    done = subprocess.run([sys.executable, "-c", make], check=False, env=with_package())
    assert done.returncode == 0


def supervisors(mark: str) -> list[int]:
    return [pid for pid, words in commands() if words[0] == "/supervisor" and mark in words]


def signal_supervisor(mark: str, number: int) -> bool:
    if not until(lambda: supervisors(mark)):
        return False
    os.kill(supervisors(mark)[0], number)
    return True


def test_a_dead_supervisor_is_a_loss(box: Box) -> None:
    mark = f"601.{os.getpid()}"
    with ThreadPoolExecutor(1) as pool:
        killed = pool.submit(signal_supervisor, mark, signal.SIGKILL)
        result = box.run(["sleep", mark], collect=["a"])
    assert killed.result()
    assert result.outcome == "lost"
    assert result.describe() == "the box gave no complete report"
    assert (result.files, result.file_errors) == ({}, {})


def test_a_hung_supervisor_is_a_loss(box: Box, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("raybook_grader.sandbox.box._FENCE_SECONDS", 1)
    mark = f"602.{os.getpid()}"
    with ThreadPoolExecutor(1) as pool:
        stopped = pool.submit(signal_supervisor, mark, signal.SIGSTOP)
        result = box.run(["sleep", mark], limits=replace(QUICK, wall_seconds=1))
    assert stopped.result()
    assert result.outcome == "lost"
    assert until(lambda: not supervisors(mark) and not sleepers(mark))
