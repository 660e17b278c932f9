"""From the supervisor's report to the result that the harness sees."""

from __future__ import annotations

import errno
import os
import signal
from collections.abc import Callable
from dataclasses import replace

from .exchange import Stream
from .limits import Limits
from .report import Report
from .result import BoxResult, Outcome

_Ending = tuple[Outcome, str]


def conclude(report: Report | None, stdout: Stream, stderr: Stream, limits: Limits) -> BoxResult:
    """The result of a run; no report, or one that makes no sense, is "lost"."""
    text = BoxResult(
        outcome="lost",
        detail="the box gave no complete report",
        stdout=bytes(stdout.data),
        stderr=bytes(stderr.data),
        stdout_cut=stdout.cut,
        stderr_cut=stderr.cut,
    )
    if report is None:
        return text
    outcome, detail = _ending(report, text.output_cut, limits)
    return replace(
        text,
        outcome=outcome,
        detail=detail,
        exit_code=report.code if outcome == "exited" else None,
        signal=report.code if report.ending == "signaled" else None,
        files=report.files,
        file_errors=report.file_errors,
        cpu_seconds=report.cpu_seconds,
        wall_seconds=report.wall_seconds,
        max_rss_bytes=report.max_rss_bytes,
    )


def _ending(report: Report, flooded: bool, limits: Limits) -> _Ending:
    if report.ending == "not-started":
        return _not_started(report, limits)
    if flooded:
        return "output-flood", f"printed more than {_size(limits.output_bytes)}"
    if report.ending == "signaled" and _out_of_cpu_time(report, limits):
        return "timeout", f"used more than {limits.cpu_seconds:g} s of processor time"
    endings: dict[str, Callable[[], _Ending]] = {
        "exited": lambda: ("exited", ""),
        "signaled": lambda: ("signaled", ""),
        "timeout": lambda: ("timeout", f"no answer after {limits.wall_seconds:g} s"),
        "memory": lambda: ("memory", f"used more than {_size(limits.memory_bytes)} of memory"),
        "files": lambda: ("output-flood", f"made more than {limits.scratch_files} files"),
    }
    unknown: _Ending = ("lost", f"the box was stopped from outside ({report.ending})")
    return endings.get(report.ending, lambda: unknown)()


def _not_started(report: Report, limits: Limits) -> _Ending:
    if report.code == errno.ENOMEM:
        return "memory", f"needs more than {_size(limits.memory_bytes)} of memory to start"
    return "lost", f"the box could not start the command: {os.strerror(report.code)}"


def _out_of_cpu_time(report: Report, limits: Limits) -> bool:
    """The kernel sends SIGXCPU at the limit, and SIGKILL a second later."""
    at_limit = report.code == signal.SIGKILL and report.cpu_seconds >= limits.cpu_seconds
    return report.code == signal.SIGXCPU or at_limit


def _size(count: int) -> str:
    for unit, size in (("GiB", 1 << 30), ("MiB", 1 << 20), ("KiB", 1 << 10)):
        if count >= size:
            return f"{count / size:.3g} {unit}"
    return f"{count} bytes"
