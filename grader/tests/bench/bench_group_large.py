"""What large scenes take in memory, at the most, from the file to the picture: group `large`."""

from __future__ import annotations

import json
import subprocess
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from bench_effort import Effort
from bench_programs import BUILD, ROOT
from bench_rows import Row
from large_mesh import OWN_MEMORY, show, write_ring
from renderer_runs import Json
from renderer_runs import program as renderer

KNOT = ROOT / "build" / "meshes" / "knot-100k.obj"


def large_rows(effort: Effort) -> Iterator[Row]:
    """A mesh of ten million triangles, and a thousand instances of one of a hundred thousand."""
    stats = _render(show([KNOT] * 1000, 40.0))
    yield Row(
        "large", "instances", f"1000 knots, {stats['primitives'] / 1e6:.0f} Mtri",
        figure=stats["peak_memory_bytes"] / 2**20, unit="MiB",
    )  # fmt: skip
    if effort.large_triangles == 0:
        return
    ring = BUILD / f"ring-{effort.large_triangles}.obj"
    if not ring.is_file():
        BUILD.mkdir(parents=True, exist_ok=True)
        write_ring(ring, effort.large_triangles)
    stats = _render(show([ring], 2.2))
    yield Row(
        "large", "one mesh", f"ring, {stats['primitives'] / 1e6:.1f} Mtri",
        figure=stats["peak_memory_bytes"] / 2**30, unit="GiB",
        note=f"loaded in {stats['load_seconds']:.1f} s, built in {stats['build_seconds']:.1f} s",
    )  # fmt: skip


def _render(scene: Json) -> Any:
    """The statistics of the run."""
    with tempfile.TemporaryDirectory(prefix="raybook-") as folder:
        file = Path(folder, "scene.json")
        file.write_text(json.dumps(scene), encoding="utf-8")
        command = [
            *OWN_MEMORY,
            str(renderer()),
            str(file),
            "-o",
            "o.exr",
            "--stats",
            "-",
            "--quiet",
        ]
        done = subprocess.run(command, cwd=folder, check=True, capture_output=True, text=True)
        return json.loads(done.stdout)
