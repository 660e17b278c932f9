"""`raybook-grader doctor`: what a machine offers, on this one and on one without bubblewrap."""

from __future__ import annotations

import json
import subprocess
import sys

from poor_machine import without_bubblewrap
from tiny_programs import RunC

from raybook_grader.sandbox import Finding
from raybook_grader.sandbox.commands import is_safe
from raybook_grader.sandbox.survey import landlock_abi, survey

DOCTOR = [sys.executable, "-m", "raybook_grader", "doctor"]


def run(command: list[str]) -> subprocess.CompletedProcess[str]:
    return subprocess.run(command, capture_output=True, text=True, check=False)


def test_this_machine_is_safe_and_the_table_says_why() -> None:
    ended = run(DOCTOR)
    assert ended.returncode == 0, ended.stdout + ended.stderr
    first = [line.split("  ")[0] for line in ended.stdout.splitlines()]
    for name in ("kernel", "bubblewrap", "system call filter", "supervisor", "trial box",
                 "user namespaces", "landlock", "cgroups", "memory", "disk"):  # fmt: skip
        assert name in first
    assert "Safe:" in ended.stdout and "MISSING" not in ended.stdout


def test_a_machine_without_bubblewrap_is_not() -> None:
    ended = run(without_bubblewrap(DOCTOR))
    assert ended.returncode == 1
    assert "apt-get install bubblewrap" in ended.stdout and "Not safe" in ended.stdout
    told = run(without_bubblewrap([*DOCTOR, "--json"]))
    values = json.loads(told.stdout)
    assert told.returncode == 1 and values["safe"] is False
    [missing] = [f for f in values["findings"] if f["needed"] and not f["ok"]]
    assert missing["name"] == "bubblewrap" and missing["remedy"]


def test_only_what_is_needed_decides() -> None:
    weak = Finding("landlock", False, "not there", needed=False)
    assert is_safe([weak]) and not is_safe([weak, Finding("bubblewrap", False, "not there")])
    assert {finding.name for finding in survey() if not finding.needed} >= {"landlock", "cgroups"}


def test_landlock_is_one_more_wall(run_c: RunC) -> None:
    """What lies in /proc is writable by its owner as far as mounts and rights go."""
    body = 'errno = 0; int fd = open("/proc/self/comm", O_WRONLY); printf("%d %d", fd >= 0, errno);'
    result = run_c(body)
    assert result.stdout == (b"0 13" if landlock_abi() else b"1 0")


def test_landlock_leaves_the_scratch_folders(run_c: RunC) -> None:
    body = """
        const char *const places[] = {"/work/a", "/tmp/a", "/dev/shm/a", "/dev/null"};
        for (int i = 0; i < 4; i++) {
            int fd = open(places[i], O_WRONLY | O_CREAT, 0644);
            printf("%d", fd >= 0 && write(fd, "x", 1) == 1);
        }
        printf("%d", mkdir("/work/f", 0755) == 0 && rename("/work/a", "/work/f/a") == 0 &&
               truncate("/work/f/a", 0) == 0 && unlink("/work/f/a") == 0);
    """
    assert run_c(body).stdout == b"11111"
