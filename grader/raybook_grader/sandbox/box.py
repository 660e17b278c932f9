"""Running one command where it can do no harm."""

from __future__ import annotations

import fcntl
import os
import posixpath
import subprocess
from collections.abc import Iterable, Mapping, Sequence
from contextlib import ExitStack
from pathlib import Path
from types import TracebackType
from typing import Self

from .arguments import Plan, command_line
from .build import supervisor_path
from .ending import conclude
from .errors import BoxError
from .exchange import Stream, listen
from .limits import Limits
from .mirror import Mirror
from .report import parse_report
from .result import BoxResult
from .seccomp import filter_program

_FENCE_SECONDS = 20.0
_OWN_PLACES = ("/", "/usr", "/work", "/tmp", "/dev", "/proc", "/sys", "/etc", "/supervisor")
_NO_FILES: Mapping[str, Path] = {}
_SEALS = fcntl.F_SEAL_WRITE | fcntl.F_SEAL_GROW | fcntl.F_SEAL_SHRINK


class Box:
    """Makes boxes; holds nothing but copies of files that nobody could not read in place.

    Inside: the host's /usr read-only, the binds and inputs read-only, empty /work (the current
    folder), /tmp and /dev/shm in memory, no network, no other process. Every run starts afresh.
    Usable from many threads at once; each process should have its own.
    """

    def __init__(self, unchanging: Iterable[Path] = ()) -> None:
        """`unchanging` names large bind folders that stay as they are while this object lives."""
        self._supervisor = supervisor_path()
        self._mirror = Mirror([self._supervisor, *unchanging])

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:  # fmt: skip
        self.close()

    def close(self) -> None:
        """Removes the copies made; also happens when the object goes away."""
        self._mirror.close()

    def run(
        self,
        command: Sequence[str],
        *,
        binds: Mapping[str, Path] = _NO_FILES,
        inputs: Mapping[str, bytes] | None = None,
        collect: Sequence[str] = (),
        limits: Limits | None = None,
        env: Mapping[str, str] | None = None,
        stdin: bytes = b"",
    ) -> BoxResult:
        """Runs a command to its end or its limits, and collects files from /work.

        `command[0]` is a path in the box or a name in /usr/bin. `binds` maps absolute box paths
        to the host's files or folders, `inputs` box paths (relative ones are below /work) to
        contents, which may be executed; both are read-only inside. `collect` names files
        relative to /work. `env` adds to PATH, HOME, TMPDIR and LC_ALL. Raises BoxError if the
        request makes no sense and SandboxUnavailable if this machine cannot make a box; whatever
        the command does is told in the result.
        """
        limits = limits or Limits()
        inputs = {posixpath.join("/work", path): data for path, data in (inputs or {}).items()}
        _check_request(command, binds, inputs, collect, env or {})
        with ExitStack() as open_files:
            report, report_end = _pipe(open_files)
            control_end, control = _pipe(open_files)
            plan = Plan(
                command=command,
                collect=collect,
                limits=limits,
                environment=env or {},
                binds={path: self._mirror.readable(host) for path, host in binds.items()},
                inputs={path: _memory(open_files, data) for path, data in inputs.items()},
                supervisor=self._mirror.readable(self._supervisor),
                seccomp=_memory(open_files, filter_program()),
                report=report_end,
                control=control_end,
            )
            return _run(plan, stdin, report, control, open_files)


def _run(
    plan: Plan, stdin: bytes, report_fd: int, control: int, open_files: ExitStack
) -> BoxResult:
    ends = [_pipe(open_files), _pipe(open_files)]
    text = [Stream(read, plan.limits.output_bytes) for read, _ in ends]
    report = Stream(report_fd)
    process = subprocess.Popen(
        command_line(plan),
        stdin=_memory(open_files, stdin),
        stdout=ends[0][1],
        stderr=ends[1][1],
        pass_fds=plan.descriptors(),
        env={"PATH": "/usr/bin:/bin"},
        cwd="/",
        start_new_session=True,  # a Ctrl-C at the terminal is the harness's to handle
    )
    in_time = listen(process, text, report, control, plan.limits.wall_seconds + _FENCE_SECONDS)
    parsed = parse_report(bytes(report.data), plan.collect) if in_time else None
    return conclude(parsed, text[0], text[1], plan.limits)


def _pipe(open_files: ExitStack) -> tuple[int, int]:
    ends = os.pipe2(os.O_CLOEXEC)
    for end in ends:
        open_files.callback(os.close, end)
    return ends


def _memory(open_files: ExitStack, data: bytes) -> int:
    """A descriptor to read the bytes from, which a box cannot change or make grow."""
    descriptor = os.memfd_create("raybook", os.MFD_CLOEXEC | os.MFD_ALLOW_SEALING)
    open_files.callback(os.close, descriptor)
    view = memoryview(data)
    while view:
        view = view[os.write(descriptor, view) :]
    os.lseek(descriptor, 0, os.SEEK_SET)
    fcntl.fcntl(descriptor, fcntl.F_ADD_SEALS, _SEALS)
    return descriptor


def _check_request(
    command: Sequence[str], binds: Mapping[str, Path], inputs: Mapping[str, bytes],
    collect: Sequence[str], env: Mapping[str, str],
) -> None:  # fmt: skip
    if not command:
        raise BoxError("the command is empty")
    for word in (*command, *env, *env.values()):
        if "\0" in word:
            raise BoxError(f"a null byte in {word!r}")
    for path in (*binds, *inputs):
        if not path.startswith("/") or posixpath.normpath(path) != path or "\0" in path:
            raise BoxError(f"bad box path {path!r}: expected an absolute, normal path")
        if path in _OWN_PLACES or path.startswith(("/dev/", "/proc/", "/sys/", "/usr/")):
            raise BoxError(f"bad box path {path!r}: that place belongs to the box")
    for path in binds.keys() & inputs.keys():
        raise BoxError(f"{path} is both bound and given as an input")
    for name in collect:
        if not _is_plain(name):
            raise BoxError(f"cannot collect {name!r}: expected a plain path relative to /work")


def _is_plain(name: str) -> bool:
    steps = name.split("/")
    return "\0" not in name and all(step not in ("", ".", "..") for step in steps)
