"""Whether this machine can make a box, and what to do if it cannot."""

from __future__ import annotations

import os
import platform
import re
import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path

from .arguments import find_program
from .box import Box
from .build import supervisor_path
from .errors import SandboxUnavailable
from .limits import Limits
from .seccomp import filter_program

_OLDEST_BUBBLEWRAP = (0, 8)
_OLDEST_LINUX = (5, 14)
_SWITCHES = {
    "kernel/unprivileged_userns_clone": ("0", "sysctl -w kernel.unprivileged_userns_clone=1"),
    "user/max_user_namespaces": ("0", "sysctl -w user.max_user_namespaces=15000"),
    "kernel/apparmor_restrict_unprivileged_userns": (
        "1",
        "sysctl -w kernel.apparmor_restrict_unprivileged_userns=0",
    ),
}


@dataclass(frozen=True)
class Finding:
    """One thing that a box needs: whether it is there, and if not, the remedy."""

    name: str
    ok: bool
    message: str
    remedy: str = ""
    needed: bool = True
    """False for what only helps."""


def probe() -> list[Finding]:
    """Looks at everything a box needs, ending with a real one if the rest is in order."""
    findings = [_kernel(), _bubblewrap(), *_setpriv(), _filter(), _supervisor()]
    if all(finding.ok for finding in findings):
        trial = _trial()
        findings += [trial] if trial.ok else [trial, *_switches()]
    return findings


def require() -> None:
    """Returns if students' code can be run safely; raises SandboxUnavailable, in words, if not."""
    bad = [finding for finding in probe() if not finding.ok]
    if bad:
        lines = [f"  {f.name}: {f.message}" + (f"\n    remedy: {f.remedy}" if f.remedy else "")
                 for f in bad]  # fmt: skip
        raise SandboxUnavailable(
            "students' code can only be run in a sandbox, and this machine cannot make one:\n"
            + "\n".join(lines)
        )


def _kernel() -> Finding:
    release = platform.release()
    new_enough = platform.system() == "Linux" and _version(release) >= _OLDEST_LINUX
    return Finding(
        "kernel", new_enough, f"{platform.system()} {release}",
        "" if new_enough else "use Linux 5.14 or newer (process limits a user namespace)",
    )  # fmt: skip


def _bubblewrap() -> Finding:
    remedy = "apt-get install bubblewrap (0.8 or newer)"
    try:
        done = subprocess.run(
            [find_program("bwrap"), "--version"], capture_output=True, text=True, check=True
        )
    except (SandboxUnavailable, OSError, subprocess.CalledProcessError) as error:
        return Finding("bubblewrap", False, str(error), remedy)
    new_enough = _version(done.stdout) >= _OLDEST_BUBBLEWRAP
    return Finding("bubblewrap", new_enough, done.stdout.strip(), "" if new_enough else remedy)


def _setpriv() -> list[Finding]:
    if os.geteuid() != 0:
        return []
    found = shutil.which("setpriv")
    remedy = "" if found else "apt-get install util-linux, or do not run as root"
    return [Finding("setpriv", found is not None, found or "setpriv is not in PATH", remedy)]


def _switches() -> list[Finding]:
    """Settings that forbid user namespaces; bwrap may be excepted, so only a failure counts."""
    findings = []
    for name, (forbidding, remedy) in _SWITCHES.items():
        path = Path("/proc/sys") / name
        if path.exists() and path.read_text().strip() == forbidding:
            setting = f"{name.replace('/', '.')} is {forbidding}"
            findings.append(Finding("user namespaces", False, setting, remedy))
    return findings


def _filter() -> Finding:
    try:
        filter_program()
    except SandboxUnavailable as error:
        return Finding("system call filter", False, str(error))
    return Finding("system call filter", True, platform.machine())


def _supervisor() -> Finding:
    try:
        return Finding("supervisor", True, str(supervisor_path()))
    except SandboxUnavailable as error:
        return Finding("supervisor", False, str(error), "apt-get install gcc libc6-dev")


def _trial() -> Finding:
    with Box() as box:
        try:
            result = box.run(["/bin/true"], limits=Limits(wall_seconds=30))
        except (SandboxUnavailable, OSError) as error:
            return Finding("trial box", False, str(error))
    words = result.stderr.decode("utf-8", "replace").strip()
    message = result.describe() + (f": {words}" if words else "")
    remedy = "" if result.ok else "allow unprivileged user namespaces (inside a container too)"
    return Finding("trial box", result.ok, message, remedy)


def _version(text: str) -> tuple[int, ...]:
    found = re.search(r"(\d+)\.(\d+)", text)
    return (int(found[1]), int(found[2])) if found else (0, 0)
