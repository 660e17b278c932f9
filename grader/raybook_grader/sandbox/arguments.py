"""The command line that makes a box around the supervisor."""

from __future__ import annotations

import math
import os
import shutil
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from .errors import SandboxUnavailable
from .limits import Limits
from .mirror import NOBODY

SUPERVISOR = "/supervisor"
_SHARED_MEMORY_BYTES = 1024 * 1024
_SYSTEM_FOLDERS = ("bin", "sbin", "lib", "lib32", "lib64", "libx32")
_DEFAULT_ENVIRONMENT = {
    "PATH": "/usr/bin:/bin",
    "HOME": "/work",
    "TMPDIR": "/tmp",
    "LC_ALL": "C.UTF-8",
}


@dataclass(frozen=True)
class Plan:
    """All that one box is made of; paths on the left are the box's."""

    command: Sequence[str]
    collect: Sequence[str]
    limits: Limits
    environment: Mapping[str, str]
    binds: Mapping[str, Path]
    inputs: Mapping[str, int]
    """Descriptors that hold the bytes."""
    supervisor: Path
    seccomp: int
    report: int
    control: int

    def descriptors(self) -> list[int]:
        """Everything that must reach bubblewrap."""
        return [self.seccomp, self.report, self.control, *self.inputs.values()]


def command_line(plan: Plan) -> list[str]:
    """The whole command. Nothing passes through a shell."""
    return [*_drop_root(), find_program("bwrap"), *_box(plan), "--", *_supervise(plan)]


def find_program(name: str) -> str:
    """A tool's absolute path; raises SandboxUnavailable if it is not there."""
    found = shutil.which(name, path="/usr/bin:/bin:/usr/local/bin:" + os.environ.get("PATH", ""))
    if found is None:
        raise SandboxUnavailable(f"{name} is not in PATH")
    return found


def _drop_root() -> list[str]:
    """Started by root, bubblewrap leaves /proc/sys writable and root's files readable."""
    if os.geteuid() != 0:
        return []
    return [
        find_program("setpriv"), "--reuid", str(NOBODY), "--regid", str(NOBODY),
        "--clear-groups", "--inh-caps=-all", "--",
    ]  # fmt: skip


def _box(plan: Plan) -> list[str]:
    """Order matters: mounts are made one after the other, and sealed last."""
    return [
        "--unshare-all", "--unshare-user", "--disable-userns", "--uid", str(NOBODY),
        "--gid", str(NOBODY), "--as-pid-1", "--die-with-parent", "--new-session",
        "--cap-drop", "ALL", "--hostname", "box", "--seccomp", str(plan.seccomp),
        "--clearenv", *_environment(plan.environment),
        *_system(), "--proc", "/proc", "--dev", "/dev",
        *_tmpfs("/dev/shm", _SHARED_MEMORY_BYTES),
        *_tmpfs("/tmp", plan.limits.scratch_bytes), *_tmpfs("/work", plan.limits.scratch_bytes),
        "--ro-bind", str(plan.supervisor), SUPERVISOR,
        *_binds(plan.binds), *_inputs(plan.inputs),
        "--remount-ro", "/dev", "--remount-ro", "/", "--chdir", "/work",
    ]  # fmt: skip


def _environment(extra: Mapping[str, str]) -> list[str]:
    merged = _DEFAULT_ENVIRONMENT | dict(extra)
    return [word for name, value in merged.items() for word in ("--setenv", name, value)]


def _system() -> list[str]:
    """The toolchain and the system's libraries, laid out as on the host."""
    words = ["--ro-bind", "/usr", "/usr"]
    for name in _SYSTEM_FOLDERS:
        host = Path("/") / name
        if host.is_symlink():
            words += ["--symlink", os.readlink(host), str(host)]
        elif host.is_dir():
            words += ["--ro-bind", str(host), str(host)]
    for extra in ("/etc/ld.so.cache", "/etc/alternatives"):
        words += ["--ro-bind-try", extra, extra]
    return words


def _tmpfs(path: str, size: int) -> list[str]:
    return ["--size", str(size), "--tmpfs", path]


def _binds(binds: Mapping[str, Path]) -> list[str]:
    # Outer folders first, so that a bind inside another one is not hidden by it.
    return [w for box in sorted(binds) for w in ("--ro-bind", str(binds[box]), box)]


def _inputs(inputs: Mapping[str, int]) -> list[str]:
    words = []
    for box, descriptor in inputs.items():
        words += ["--perms", "0555", "--ro-bind-data", str(descriptor), box]
    return words


def _supervise(plan: Plan) -> list[str]:
    """The order of supervisor/order.c."""
    limits = plan.limits
    numbers = (
        plan.report, plan.control, math.ceil(limits.wall_seconds * 1000),
        math.ceil(limits.cpu_seconds), limits.memory_bytes if limits.address_space else 0,
        limits.memory_bytes, limits.file_bytes, limits.processes, limits.scratch_files,
        len(plan.collect),
    )  # fmt: skip
    return [SUPERVISOR, *map(str, numbers), *plan.collect, *plan.command]
