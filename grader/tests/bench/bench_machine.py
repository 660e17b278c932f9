"""The machine that is measured on, and a processor of it to be alone on."""

from __future__ import annotations

import os
import platform
import re
import subprocess
from pathlib import Path


def describe() -> dict[str, str | int | float]:
    """Whatever a figure depends on: for the head of the table."""
    return {
        "processor": _processor(),
        "cores": len(processors()),
        "memory_gib": round(os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE") / 2**30, 1),
        "system": f"{platform.system()} {platform.release()}",
        "compiler": _first_line("gcc", "--version"),
        "load_average": round(os.getloadavg()[0], 2),
    }


def busy() -> str:
    """What to say of a figure taken by the clock; empty: nothing but this ran."""
    load = os.getloadavg()[0]
    return f"load average {load:.1f}: others were at work" if load > 1.5 * len(processors()) else ""


def processors() -> list[int]:
    """Those that this process may use."""
    return sorted(os.sched_getaffinity(0))


def pinned(command: list[str]) -> list[str]:
    """The command, bound to the last processor: the first is the one that most interrupts go to."""
    return ["taskset", "--cpu-list", str(processors()[-1]), *command]


def _processor() -> str:
    file = Path("/proc/cpuinfo")
    text = file.read_text() if file.is_file() else ""
    found = re.search(r"^model name\s*: (.*)$", text, re.MULTILINE)
    return found[1] if found else platform.processor() or platform.machine()


def _first_line(*command: str) -> str:
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=True)
    except (OSError, subprocess.CalledProcessError):
        return "unknown"
    return done.stdout.splitlines()[0]
