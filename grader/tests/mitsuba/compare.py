"""Compare the renderer with Mitsuba 3 on the scenes in scenes/test/compare.

    make mitsuba [ARGS="--spp 4096"]
    grader/tests/mitsuba/compare.sh [--raybook build/raybook] [--spp 1024] [scene.json ...]

A test of record, which takes minutes; compare.sh makes the environment that it needs.
Both programs render every scene from many seeds; the grader's own judge then says whether ours
converges to what Mitsuba converges to. A scene fails when a channel's mean differs by more than
0.5 %, when the judge's verdict (part A) is not "pass", or when single pixels differ by more than
noise (pixel_bias.py). The exit code is 1 if any scene fails.
"""

import argparse
import json
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from convert import convert
from make_images import make_images
from mitsuba_types import load_mitsuba
from pixel_bias import PixelBias, pixel_bias

from raybook_grader.judge.bias import verdict
from raybook_grader.judge.exr import read_exr
from raybook_grader.judge.findings import BiasVerdict
from raybook_grader.judge.pixels import Array, Image
from raybook_grader.judge.reference import reduce_reference
from raybook_grader.judge.thresholds import ALL_TILES, CAUSTIC_TILES

TOP = Path(__file__).resolve().parents[3]
SCENES = TOP / "scenes" / "test" / "compare"

SEEDS = 16
REFERENCE_CHUNKS = 64
REFERENCE_SHARE = 4  # the reference gets this many times our samples
MEAN_LIMIT = 0.005


@dataclass(frozen=True)
class Options:
    """What the command line says."""

    raybook: Path
    spp: int  # of ours, all seeds together
    threads: int


@dataclass(frozen=True)
class Row:
    """One scene's result: relative differences of the means, and how well each is known."""

    name: str
    difference: Array  # (3,)
    error: Array  # (3,), one standard deviation
    judged: BiasVerdict
    pixels: PixelBias
    ours_seconds: float
    mitsuba_seconds: float

    @property
    def fine(self) -> bool:
        """Does it pass?"""
        close = bool((np.abs(self.difference) <= MEAN_LIMIT).all())
        return close and self.judged.status == "pass" and self.pixels.fine


def mitsuba_renders(path: Path, chunk_spp: int) -> list[Image]:
    """One image a seed."""
    mi = load_mitsuba()
    scene = mi.load_dict(convert(path))
    return [
        np.array(mi.render(scene, spp=chunk_spp, seed=seed), dtype=np.float32)
        for seed in range(REFERENCE_CHUNKS)
    ]


def our_renders(
    path: Path, options: Options, folder: Path, seeds: Sequence[int]
) -> Iterator[Image]:
    """One image a seed."""
    out = folder / "ours.exr"
    for seed in seeds:
        command = [str(options.raybook), str(path), "--output", str(out), "--quiet"]
        command += ["--seed", str(seed), "--spp", str(options.spp // SEEDS)]
        command += ["--threads", str(options.threads)]
        subprocess.run(command, check=True)
        yield read_exr(out).pixels


def compare(path: Path, options: Options) -> Row:
    """Render one scene with both and judge."""
    start = time.monotonic()
    chunk_spp = max(1, REFERENCE_SHARE * options.spp // REFERENCE_CHUNKS)
    chunks = mitsuba_renders(path, chunk_spp)
    reference = reduce_reference(chunks, chunk_spp, REFERENCE_CHUNKS)
    middle = time.monotonic()
    first: list[Image] = []

    def render(seeds: Sequence[int]) -> list[Image]:
        with tempfile.TemporaryDirectory() as folder:
            images = list(our_renders(path, options, Path(folder), seeds))
        if not first:
            first.extend(images)
        return images

    judged = verdict(
        render,
        reference,
        options.spp // SEEDS,
        tile_sizes=tile_sizes(path),
        seeds=range(1, SEEDS + 1),
        fresh_seeds=range(1001, SEEDS + 1001),
    )
    seconds = time.monotonic() - middle
    means = np.stack(first).mean(axis=(1, 2), dtype=np.float64)
    scale = reference.channel_mean
    variance = means.var(axis=0, ddof=1) / SEEDS + reference.channel_variance
    return Row(
        name=path.stem,
        difference=means.mean(axis=0) / scale - 1,
        error=np.sqrt(variance) / scale,
        judged=judged,
        pixels=pixel_bias(first, chunks, REFERENCE_SHARE),
        ours_seconds=seconds,
        mitsuba_seconds=middle - start,
    )


def tile_sizes(path: Path) -> tuple[int, ...]:
    """Caustics need large tiles: so the judge says, and so the grader's own scenes do."""
    materials = json.loads(path.read_text(encoding="utf-8")).get("materials", {})
    glass = any(material["type"] == "glass" for material in materials.values())
    return CAUSTIC_TILES if glass else ALL_TILES


HEAD = (
    f"{'scene':24s}{'red %':>16s}{'green %':>16s}{'blue %':>16s}"
    f"{'tiles %':>9s}{'pixels %':>16s}{'noise':>7s}{'ours s':>8s}{'Mitsuba s':>11s}  verdict"
)


def line_of(row: Row) -> str:
    """A row of the table: differences of the means as value +- standard error."""
    cells = "".join(
        f"{f'{100 * d:+.3f} ±{100 * e:.3f}':>16s}"
        for d, e in zip(row.difference, row.error, strict=True)
    )
    rms = "" if row.judged.rms_bias is None else f"{100 * row.judged.rms_bias:.2f}"
    pixels = f"{100 * row.pixels.rms:.2f} ({row.pixels.deviations:+.1f}σ)"
    noise = "" if row.judged.noise_ratio is None else f"{row.judged.noise_ratio:.2f}"
    reasons = "; ".join(reason.sentence for reason in row.judged.reasons)
    end = f"{row.judged.status}{'' if row.fine else '  FAILS'} {reasons}".rstrip()
    seconds = f"{row.ours_seconds:8.1f}{row.mitsuba_seconds:11.1f}"
    return f"{row.name:24s}{cells}{rms:>9s}{pixels:>16s}{noise:>7s}{seconds}  {end}"


def prepare() -> None:
    """Write the images and meshes that the scenes name."""
    make_images(TOP / "build" / "compare")
    command = [sys.executable, str(TOP / "scenes" / "make_meshes.py"), str(TOP / "build/meshes")]
    subprocess.run(command, check=True)


def main() -> int:
    """The command; returns its exit code."""
    parser = argparse.ArgumentParser(description="Compare the renderer with Mitsuba 3.")
    parser.add_argument("--raybook", type=Path, default=TOP / "build" / "raybook")
    parser.add_argument("--spp", type=int, default=1024, help="of ours, all seeds together")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("scenes", type=Path, nargs="*", help="default: all of scenes/test/compare")
    given = parser.parse_args()
    if given.spp < SEEDS:
        parser.error(f"--spp {given.spp}: expected at least {SEEDS}, the number of seeds")
    prepare()
    options = Options(given.raybook.resolve(), given.spp, given.threads)
    print(HEAD)
    failed = 0
    for path in given.scenes or sorted(SCENES.glob("*.json")):
        row = compare(path.resolve(), options)
        failed += not row.fine
        print(line_of(row), flush=True)
    print(f"{failed} failed" if failed else "all pass")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
