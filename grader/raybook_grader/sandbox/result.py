"""What came of one run in a box."""

from __future__ import annotations

import signal as signals
from dataclasses import dataclass, field
from typing import Literal

Outcome = Literal["exited", "signaled", "timeout", "memory", "output-flood", "lost"]

_SIGNAL_WORDS = {
    signals.SIGILL: "illegal instruction",
    signals.SIGABRT: "aborted: a failed assertion or a damaged heap",
    signals.SIGBUS: "bus error",
    signals.SIGFPE: "arithmetic error, such as an integer division by zero",
    signals.SIGKILL: "killed",
    signals.SIGSEGV: "segmentation fault",
    signals.SIGPIPE: "broken pipe",
    signals.SIGSYS: "forbidden system call",
    signals.SIGTERM: "terminated",
    signals.SIGTRAP: "trap",
    signals.SIGXFSZ: "file too large",
}


@dataclass(frozen=True)
class BoxResult:
    """How a command ended, and what it left. Everything but `outcome` "lost" is its own doing.

    Never a verdict: exit code, signal and text come from the command and only explain. Names in
    `collect` appear in exactly one of `files` and `file_errors`, except that after "lost" (no
    trustworthy report) both are empty.
    """

    outcome: Outcome
    """"exited" and "signaled" ended by themselves; "timeout" (real or processor time), "memory"
    and "output-flood" (text or number of files) were ended by a limit; "lost" means that the box
    gave no complete report or could not start the command: the harness's failure."""
    detail: str = ""
    """Words on a limit or a loss; empty for "exited" and "signaled"."""
    exit_code: int | None = None
    """Set for "exited" only."""
    signal: int | None = None
    """Set when a signal that the supervisor did not send ended the command."""
    stdout: bytes = b""
    stderr: bytes = b""
    stdout_cut: bool = False
    stderr_cut: bool = False
    files: dict[str, bytes] = field(default_factory=dict)
    file_errors: dict[str, str] = field(default_factory=dict)
    """Why a file was not collected: "missing", "not a regular file", "too large", "unreadable"."""
    cpu_seconds: float = 0.0
    """User and system time of every process of the box."""
    wall_seconds: float = 0.0
    max_rss_bytes: int = 0
    """Peak resident memory of the largest process."""

    @property
    def ok(self) -> bool:
        """Whether the command ended by itself with exit code 0."""
        return self.outcome == "exited" and self.exit_code == 0

    @property
    def output_cut(self) -> bool:
        """Whether text was thrown away."""
        return self.stdout_cut or self.stderr_cut

    def describe(self) -> str:
        """The ending in a few words; holds no text that the command wrote."""
        if self.outcome == "exited":
            return "finished" if self.exit_code == 0 else f"ended with exit code {self.exit_code}"
        if self.outcome == "signaled":
            return f"killed by signal {self.signal} ({signal_words(self.signal or 0)})"
        return self.detail


def signal_words(number: int) -> str:
    """A signal in plain words."""
    try:
        return _SIGNAL_WORDS.get(signals.Signals(number), signals.Signals(number).name)
    except ValueError:
        return "real-time signal"
