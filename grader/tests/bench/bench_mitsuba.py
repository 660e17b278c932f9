"""Mitsuba renders one scene again and again, when it is told to: the counterpart of bench_image.c.

    bench_mitsuba.py SCENE.json VARIANT SAMPLER

runs in Mitsuba's own environment (grader/tests/mitsuba/environment.sh). SAMPLER is one of Mitsuba's
plugins, then with Mitsuba's own Russian roulette; "-": independent samples and no roulette, which
is what the converter writes.
"""

import os
import sys
import time
from importlib import import_module
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "mitsuba"))

from convert import convert
from mitsuba_types import find_llvm

ROULETTE_DEPTH = 5  # Mitsuba's default
THREADS = 2  # of one processor: scalar_rgb hangs with one


def main() -> int:
    """Serve until the standard input ends."""
    path, variant, sampler = sys.argv[1:]
    find_llvm()
    mi = import_module("mitsuba")
    if variant not in mi.variants():
        print(f"this Mitsuba has no variant {variant}", file=sys.stderr)
        return 1
    mi.set_variant(variant)
    import_module("drjit").set_thread_count(THREADS)
    plugin = convert(Path(path))
    if sampler != "-":
        plugin["sensor"]["sampler"] = {"type": sampler}
        plugin["integrator"]["rr_depth"] = ROULETTE_DEPTH
    scene = mi.load_dict(plugin)
    answers = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)  # what Mitsuba prints is no answer
    print("ready", variant, file=answers, flush=True)
    for line in sys.stdin:
        seed, spp, _, out = line.split()
        wall, cpu = time.monotonic(), time.process_time()
        picture = np.array(mi.render(scene, spp=int(spp), seed=int(seed)), dtype=np.float32)
        cpu, wall = time.process_time() - cpu, time.monotonic() - wall
        picture.tofile(out)
        print(f"{cpu:.6f} {wall:.6f}", file=answers, flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
