"""The reference renderer, with some exercises as stubs where a picture asks for it."""

from __future__ import annotations

import os
import subprocess
from functools import cache
from pathlib import Path

from ..errors import BadInput

# A make around us has settings of its own, which the reference must not have.
_SETTINGS = {"MAKEFLAGS", "MFLAGS", "MAKELEVEL", "CC", "CFLAGS", "LDFLAGS", "OPT", "ARCH"}
_SETTINGS |= {"VARIANT", "TODO", "CHECK", "EMBREE", "V"}


@cache
def reference_program(root: Path, stubs: frozenset[str] = frozenset()) -> Path:
    """The program built from the checkout ``root``, up to date. ``stubs`` names exercises."""
    environment = {k: v for k, v in os.environ.items() if k not in _SETTINGS}
    todo = f"TODO={' '.join(sorted(stubs))}"
    command = ["make", f"-j{os.cpu_count() or 1}", "CHECK=yes", todo]
    command += ["build/meshes/done", "programs"]
    done = subprocess.run(command, cwd=root, env=environment, capture_output=True, text=True)
    if done.returncode != 0:
        raise BadInput(f"{root}: the reference cannot be built:\n{done.stderr[-2000:]}")
    return root / done.stdout.splitlines()[-1]
