"""Shared by the sandbox's tests."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import raybook_grader
from raybook_grader.sandbox import BoxResult, Limits

QUICK = Limits(wall_seconds=20, memory_bytes=256 << 20, processes=16, output_bytes=65536)

PRELUDE = """
#define _GNU_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <sys/wait.h>
#include <unistd.h>
"""

Compile = Callable[..., bytes]
RunC = Callable[..., BoxResult]


def with_package() -> dict[str, str]:
    """An environment in which another Python finds the package under test."""
    package = Path(raybook_grader.__file__).parents[1]
    return {**os.environ, "PYTHONPATH": str(package)}
