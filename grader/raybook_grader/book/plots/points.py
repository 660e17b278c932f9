"""Points of the samplers, by the samplers of the checkout."""

from __future__ import annotations

import subprocess
import tempfile
from pathlib import Path

import numpy as np

from ...errors import BadInput
from ...judge.pixels import Array

_DRIVER = Path(__file__).with_name("points.c")
_MODULES = ("src/sampling/sampler.c", "src/sampling/scramble.c")


def sampler_points(root: Path, kind: str, count: int) -> Array:
    """`count` points of one pixel, (count, 2)."""
    with tempfile.TemporaryDirectory(prefix="raybook-") as folder:
        program = Path(folder, "points")
        _run(root, "gcc", "-std=c99", "-O1", "-ffp-contract=off", "-Isrc", str(_DRIVER),
             *_MODULES, "-lm", "-o", str(program))  # fmt: skip
        text = _run(root, str(program), kind, str(count))
    return np.array([[float(word) for word in line.split()] for line in text.splitlines()])


def _run(root: Path, *command: str) -> str:
    done = subprocess.run(command, cwd=root, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise BadInput(f"{command[0]}: {done.stderr.strip()[-600:]}")
    return done.stdout
