"""Running without a box, for machines that cannot make one: only when told `--unsafe`.

What remains are limits of each process, an unprivileged user when started by root, a scratch
folder, and an end for whatever stays in the command's session. Nothing keeps a program from
reading what that user may read, from the network, or from leaving processes behind.
"""

from __future__ import annotations

import contextlib
import os
import resource
import shutil
import signal
import stat
import subprocess
import tempfile
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path

from .box import Box
from .limits import Limits
from .mirror import NOBODY, Mirror
from .result import BoxResult, Outcome

_PREFIX = "raybook-unsafe-"
_TICK = 0.01
_NO_FILES: Mapping[str, Path] = {}


class UnfencedBox(Box):
    """A box in name only: the same request and the same kind of result."""

    def __init__(self, unchanging: Iterable[Path] = ()) -> None:
        self._mirror = Mirror(unchanging)

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
        """As `Box.run`, without its walls. Box paths become paths below a scratch folder."""
        limits = limits or Limits()
        with tempfile.TemporaryDirectory(prefix=_PREFIX, ignore_cleanup_errors=True) as folder:
            scratch = Path(folder)
            given = {os.path.join("/work", path): data for path, data in (inputs or {}).items()}
            (scratch / "work").mkdir()
            for path, host in binds.items():
                self._bind(host, _made(scratch, path), any(g.startswith(f"{path}/") for g in given))
            _lay_out(scratch, given)
            places = [*binds, *(path for path in given if not path.startswith("/work/"))]
            words = [_translate(word, places, scratch) for word in command]
            return _run(words, scratch, collect, limits, env or {}, stdin)

    def _bind(self, host: Path, place: Path, has_inputs: bool) -> None:
        """A link, or a copy of a folder where an input is to lie below it."""
        readable = self._mirror.readable(host)
        if has_inputs:
            shutil.copytree(readable, place)
        else:
            place.symlink_to(readable)


def _lay_out(scratch: Path, inputs: Mapping[str, bytes]) -> None:
    """Writes the inputs, and gives the scratch folders to whom the command will run as."""
    for path, data in inputs.items():
        file = _made(scratch, path)
        file.unlink(missing_ok=True)
        file.write_bytes(data)
        file.chmod(0o555)
    if os.geteuid() == 0:
        with contextlib.suppress(OSError):
            os.chown(scratch, NOBODY, NOBODY)
            os.chown(scratch / "work", NOBODY, NOBODY)


def _made(scratch: Path, path: str) -> Path:
    """The place of a box path, with the folders above it."""
    place = scratch / path.lstrip("/")
    place.parent.mkdir(parents=True, exist_ok=True)
    return place


def _translate(word: str, places: Sequence[str], scratch: Path) -> str:
    """A word that is a box path, or lies below one or beside one, as a path of the machine."""
    tops = {place.split("/")[1] for place in places}
    if word.startswith("/") and word.split("/")[1] in tops:
        return f"{scratch}{word}"
    return word


def _run(
    command: Sequence[str],
    scratch: Path,
    collect: Sequence[str],
    limits: Limits,
    env: Mapping[str, str],
    stdin: bytes,
) -> BoxResult:
    work = scratch / "work"
    with (
        tempfile.TemporaryFile() as given,
        tempfile.TemporaryFile() as out,
        tempfile.TemporaryFile() as err,
    ):
        given.write(stdin)
        given.seek(0)
        start = time.monotonic()
        try:
            process = subprocess.Popen(
                command,
                stdin=given,
                stdout=out,
                stderr=err,
                cwd=work,
                env={"PATH": "/usr/bin:/bin", "HOME": str(work), "TMPDIR": str(work),
                     "LC_ALL": "C.UTF-8", **env},
                start_new_session=True,
                preexec_fn=_limiter(limits),
            )  # fmt: skip
        except OSError as error:
            return BoxResult("lost", f"the command could not be started: {error.strerror}")
        status, usage, ended = _wait(process.pid, start + limits.wall_seconds)
        process.returncode = os.waitstatus_to_exitcode(status)
        texts = []
        for stream in (out, err):
            stream.seek(0)
            texts.append(stream.read(limits.output_bytes + 1))
    files, errors = _collect(work, collect, limits)
    cpu = usage.ru_utime + usage.ru_stime
    outcome, detail = _outcome(process.returncode, ended, cpu, limits)
    if max(map(len, texts)) > limits.output_bytes:
        outcome, detail = "output-flood", f"printed more than {limits.output_bytes} bytes"
    return BoxResult(
        outcome=outcome,
        detail=detail,
        exit_code=process.returncode if outcome == "exited" else None,
        signal=-process.returncode if outcome == "signaled" else None,
        stdout=texts[0][: limits.output_bytes],
        stderr=texts[1][: limits.output_bytes],
        files=files,
        file_errors=errors,
        cpu_seconds=cpu,
        wall_seconds=time.monotonic() - start,
        max_rss_bytes=usage.ru_maxrss * 1024,
    )


def _limiter(limits: Limits) -> Callable[[], None]:
    """What the command's process does to itself before it becomes the command."""
    cpu = int(limits.cpu_seconds) + 1
    memory = limits.memory_bytes if limits.address_space else resource.RLIM_INFINITY
    # Other commands of the same user count, too, so this only stops what never stops.
    processes = limits.processes + 256
    wanted = {
        resource.RLIMIT_CPU: (cpu, cpu + 1),
        resource.RLIMIT_AS: (memory, memory),
        resource.RLIMIT_FSIZE: (limits.file_bytes, limits.file_bytes),
        resource.RLIMIT_NOFILE: (256, 256),
        resource.RLIMIT_CORE: (0, 0),
        resource.RLIMIT_NPROC: (processes, processes),
    }
    is_root = os.geteuid() == 0

    def limit() -> None:
        if is_root:
            # In a namespace that knows one user only, its root is nobody special outside.
            with contextlib.suppress(OSError):
                os.setgroups([])
                os.setgid(NOBODY)
                os.setuid(NOBODY)
        for name, bounds in wanted.items():
            resource.setrlimit(name, bounds)

    return limit


def _wait(process: int, deadline: float) -> tuple[int, resource.struct_rusage, bool]:
    """Status and usage of the command, and whether it had to be ended."""
    ended = False
    while True:
        pid, status, usage = os.wait4(process, os.WNOHANG)
        if pid:
            break
        if not ended and time.monotonic() >= deadline:
            ended = True
            _kill_session(process)
        time.sleep(_TICK)
    _kill_session(process)  # what it has left behind
    return status, usage, ended


def _kill_session(process: int) -> None:
    with contextlib.suppress(ProcessLookupError, PermissionError):
        os.killpg(process, signal.SIGKILL)


def _outcome(code: int, ended: bool, cpu: float, limits: Limits) -> tuple[Outcome, str]:
    if ended:
        return "timeout", f"no answer after {limits.wall_seconds:g} s"
    if code == -signal.SIGXCPU or (code == -signal.SIGKILL and cpu >= limits.cpu_seconds):
        return "timeout", f"used more than {limits.cpu_seconds:g} s of processor time"
    return ("signaled", "") if code < 0 else ("exited", "")


def _collect(
    work: Path, names: Sequence[str], limits: Limits
) -> tuple[dict[str, bytes], dict[str, str]]:
    files: dict[str, bytes] = {}
    errors: dict[str, str] = {}
    for name in names:
        try:
            descriptor = os.open(work / name, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK)
        except FileNotFoundError:
            errors[name] = "missing"
            continue
        except OSError:
            errors[name] = "not a regular file"
            continue
        with os.fdopen(descriptor, "rb") as file:
            about = os.fstat(descriptor)
            if not stat.S_ISREG(about.st_mode):
                errors[name] = "not a regular file"
            elif about.st_size > limits.file_bytes:
                errors[name] = "too large"
            else:
                files[name] = file.read(limits.file_bytes)
    return files, errors


def make_box(unsafe: bool, unchanging: Iterable[Path] = ()) -> Box:
    """What students' code is run in; without walls only where that was asked for."""
    return UnfencedBox(unchanging) if unsafe else Box(unchanging)
