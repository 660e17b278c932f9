"""What this machine offers for running strangers' code: what is needed, what only helps."""

from __future__ import annotations

import ctypes
import os
import resource
import shutil
import tempfile
from pathlib import Path

from .doctor import Finding, probe

_ENOUGH_MEMORY = 2 << 30
_ENOUGH_DISK = 1 << 30
_CREATE_RULESET = 444  # landlock_create_ruleset(2), the same number on every machine
_ASK_VERSION = 1
_MORE_NAMESPACES = "sysctl -w user.max_user_namespaces=15000"


def survey() -> list[Finding]:
    """Everything that a box needs, then what only helps; those are never a reason to refuse."""
    extra = [_user_namespaces(), _landlock(), _cgroups(), _memory(), _disk(), _limits()]
    return [*probe(), *extra]


def _helps(name: str, ok: bool, message: str, remedy: str = "") -> Finding:
    return Finding(name, ok, message, "" if ok else remedy, needed=False)


def _user_namespaces() -> Finding:
    """How many are allowed; whether one can be made is for the trial box to say."""
    most = _first_line(Path("/proc/sys/user/max_user_namespaces"))
    message = f"at most {most}" if most else "no limit is told"
    return _helps("user namespaces", most != "0", message, _MORE_NAMESPACES)


def landlock_abi() -> int:
    """The version of Landlock's interface; 0 if the kernel has none or has it switched off."""
    call = ctypes.CDLL(None, use_errno=True).syscall
    return max(0, int(call(_CREATE_RULESET, None, ctypes.c_size_t(0), _ASK_VERSION)))


def _landlock() -> Finding:
    abi = landlock_abi()
    if abi:
        return _helps("landlock", True, f"ABI {abi}, used as one more wall in every box")
    return _helps("landlock", False, "not there; the box holds without it",
                  "Linux 5.13 or newer with lsm=...,landlock")  # fmt: skip


def _cgroups() -> Finding:
    top = Path("/sys/fs/cgroup")
    version = "v2" if (top / "cgroup.controllers").exists() else "v1" if top.is_dir() else "none"
    writable = os.access(top, os.W_OK) and version == "v2"
    message = f"{version}, {'writable' if writable else 'not writable'}; the box needs none"
    return _helps("cgroups", True, message)


def _memory() -> Finding:
    lines = dict(
        line.split(":", 1) for line in Path("/proc/meminfo").read_text().splitlines() if ":" in line
    )
    free = int(lines["MemAvailable"].split()[0]) * 1024
    fence = _first_line(Path("/sys/fs/cgroup/memory.max"))
    fenced = int(fence) if fence and fence.isdecimal() else None
    most = min(free, fenced or free)
    cores = len(os.sched_getaffinity(0))
    message = f"{_gib(most)} free for {cores} jobs at once" + (", fenced" if fenced else "")
    return _helps("memory", most >= _ENOUGH_MEMORY * cores, message,
                  f"fewer jobs: --jobs {max(1, most // _ENOUGH_MEMORY)}")  # fmt: skip


def _disk() -> Finding:
    folder = tempfile.gettempdir()
    free = shutil.disk_usage(folder).free
    return _helps("disk", free >= _ENOUGH_DISK, f"{_gib(free)} free in {folder}", "free some space")


def _limits() -> Finding:
    """Limits of this very process, which boxes inherit and cannot raise."""
    strict = [
        f"{name} {_gib(hard) if name == 'address space' else hard}"
        for name, number, least in (
            ("address space", resource.RLIMIT_AS, 4 << 30),
            ("open files", resource.RLIMIT_NOFILE, 1024),
            ("processes", resource.RLIMIT_NPROC, 1024),
        )
        if 0 <= (hard := resource.getrlimit(number)[1]) < least
    ]
    message = f"strict: {', '.join(strict)}" if strict else "none that would matter"
    return _helps("own limits", not strict, message, "raise them with ulimit -H")


def _first_line(path: Path) -> str:
    try:
        return path.read_text().split("\n")[0].strip()
    except OSError:
        return ""


def _gib(count: int) -> str:
    return f"{count / (1 << 30):.1f} GiB"
