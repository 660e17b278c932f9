"""Pictures to measure on: linear pixels of a scene, drawn by the renderer."""

from __future__ import annotations

import json
import subprocess
import tempfile
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from ...errors import BadInput
from ...judge.exr import read_exr
from ...judge.pixels import Array
from ..figure_spec import Picture
from ..rendering import program_of

Override = Mapping[str, object]
"""What is set in place of the scene's own, as for `--override`."""


class Renders:
    """Renders one scene, by the right program or by one with a mistake ("NN-name/slug.patch")."""

    def __init__(self, root: Path, scene: str, side: tuple[int, int], mistake: str = "") -> None:
        """`side` is the resolution, width and height."""
        self._root, self._scene, self._side = root, scene, side
        self._program = program_of(root, Picture("mistake" if mistake else "solution",
                                                 mistake=mistake))  # fmt: skip

    def draw(self, spp: int, seed: int, override: Override | None = None) -> Array:
        """Pixels (height, width, 3) in double precision."""
        width, height = self._side
        with tempfile.TemporaryDirectory(prefix="raybook-") as folder:
            out = Path(folder, "picture.exr")
            command = [str(self._program), self._scene, "--quiet", "-o", str(out),
                       "--spp", str(spp), "--seed", str(seed),
                       "--resolution", f"{width}x{height}",
                       "--override", json.dumps(override or {})]  # fmt: skip
            done = subprocess.run(
                command, cwd=self._root, capture_output=True, text=True, check=False
            )
            if done.returncode != 0:
                raise BadInput(f"{' '.join(command)}: {done.stderr.strip()[-600:]}")
            return np.asarray(read_exr(out).pixels, dtype=np.float64)
