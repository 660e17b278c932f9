"""Ten million triangles are loaded and rendered within 3 GiB: RAYBOOK_FULL=1, a minute and a half.

`make test` looks at a fiftieth of that, in proportion.
"""

from __future__ import annotations

import json
import os
from pathlib import Path

from large_mesh import OWN_MEMORY, show, write_ring
from renderer_runs import read_exr, run, write_scene

TRIANGLES = 10_000_000 if os.environ.get("RAYBOOK_FULL") == "1" else 200_000
BYTES_PER_TRIANGLE = 3 * 2**30 / 10_000_000


def test_memory_of_a_large_mesh(tmp_path: Path) -> None:
    ring = tmp_path / "ring.obj"
    count = write_ring(ring, TRIANGLES)
    scene = write_scene(tmp_path, show([ring], 2.2))
    done = run(scene, "-o", "ring.exr", "--stats", "ring.json", cwd=tmp_path, wrapper=OWN_MEMORY)
    ring.unlink()
    assert done.returncode == 0, done.stderr
    stats = json.loads((tmp_path / "ring.json").read_text())
    print(stats)
    assert stats["primitives"] == count
    assert stats["peak_memory_bytes"] < BYTES_PER_TRIANGLE * count
    lit = (read_exr(tmp_path / "ring.exr").pixels > 0.1).any(axis=-1)
    assert 0.15 < lit.mean() < 0.6
