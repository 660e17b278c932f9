"""How much each sampling method lowers the variance: one table.

    python grader/tests/renderer/variance.py [--seeds 24] [--quick] [--out build/variance]

Each row renders one scene with two ways of sampling, with equal samples a pixel, from many seeds.
A pixel's variance is that of its luminance between the seeds; a row's figure is the mean over the
pixels of the one way over that of the other, with its standard error (jackknife over the seeds).
The exit code is 1 if a figure does not reach what its row expects.
"""

from __future__ import annotations

import argparse
import json
import sys
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import numpy.typing as npt
from renderer_runs import ROOT, Json, program, read_exr, run
from variance_rows import ROWS, Row, Way

sys.path.insert(0, str(ROOT / "grader" / "tests" / "mitsuba"))

from make_images import make_images

Array = npt.NDArray[np.float64]
LUMINANCE = np.array([0.2126, 0.7152, 0.0722])
PLAIN = str(Path(__file__).resolve().parent / "variants" / "plain-sampling")


@dataclass(frozen=True)
class Renders:
    """One way's pictures of a scene: luminance of (seed, y, x), and rays in all."""

    luminance: Array
    rays: int

    @property
    def spread(self) -> Array:
        """A pixel's variance, mean over the pixels: of all seeds, then with each left out once."""
        n = len(self.luminance)
        out = np.empty(n + 1)
        out[0] = self.luminance.var(axis=0, ddof=1).mean()
        for i in range(n):
            out[i + 1] = np.delete(self.luminance, i, axis=0).var(axis=0, ddof=1).mean()
        return out


@dataclass(frozen=True)
class Measured:
    """One row's result."""

    row: Row
    plain: float  # mean variance of a pixel
    better: float
    error: float  # of the ratio, one standard deviation
    rays: float  # of the better way, over the plain one's

    @property
    def ratio(self) -> float:
        return self.plain / self.better

    @property
    def figure(self) -> float:
        """What the row is about: variance, or variance at equal work."""
        return self.ratio / self.rays if self.row.at_equal_work else self.ratio

    @property
    def fine(self) -> bool:
        return self.figure > self.row.must_beat


def render_way(row: Row, way: Way, seeds: int, folder: Path) -> Renders:
    binary = program(variant=PLAIN) if way.plain_program else program()
    out, stats = folder / "picture.exr", folder / "stats.json"
    override = json.dumps(merged(row.change, way.change))
    pictures, rays = [], 0
    for seed in range(seeds):
        arguments = ["--seed", str(seed), "--spp", str(row.spp), "--override", override]
        arguments += ["--resolution", "x".join(map(str, row.resolution)), "--quiet"]
        done = run(row.path, "-o", out, "--stats", stats, *arguments, cwd=folder, binary=binary)
        assert done.returncode == 0, done.stderr
        pictures.append(read_exr(out).pixels @ LUMINANCE)
        rays += sum(json.loads(stats.read_text("utf-8"))["rays"].values())
    return Renders(np.stack(pictures), rays)


def merged(one: Json, other: Json) -> Json:
    """As --override merges: objects by key, all else replaced."""
    both = {**one, **other}
    for key in one.keys() & other.keys():
        if isinstance(one[key], dict) and isinstance(other[key], dict):
            both[key] = merged(one[key], other[key])
    return both


def measure(row: Row, seeds: int) -> Measured:
    """Both ways of a row, and their ratio."""
    with tempfile.TemporaryDirectory() as folder:
        plain = render_way(row, row.plain, seeds, Path(folder))
        better = render_way(row, row.better, seeds, Path(folder))
    one, other = plain.spread, better.spread
    ratios = one[1:] / other[1:]
    error = np.sqrt((seeds - 1) / seeds * np.sum((ratios - ratios.mean()) ** 2))
    return Measured(row, one[0], other[0], float(error), better.rays / plain.rays)


HEAD = (
    "| what | against | scene | spp | variance | against | ratio | rays | must beat | because |\n"
    "|---|---|---|--:|--:|--:|--:|--:|--:|---|\n"
)


def line_of(m: Measured) -> str:
    """The table's line; the figure that is judged is in bold."""
    r = m.row
    ratio = f"{m.ratio:.2f} ± {m.error:.2f}"
    rays = f"{m.rays:.2f}"
    if r.at_equal_work:
        rays = f"{rays}, so **{m.figure:.2f}** at equal work"
    else:
        ratio = f"**{ratio}**"
    verdict = f"{r.must_beat:g}" + ("" if m.fine else " NOT MET")
    cells = [r.better.name, r.plain.name, r.scene, str(r.spp), f"{m.better:.3g}", f"{m.plain:.3g}"]
    return "| " + " | ".join([*cells, ratio, rays, verdict, r.because]) + " |\n"


def prepare() -> None:
    """The images and meshes that the scenes name (program() brings the demo scenes')."""
    make_images(ROOT / "build" / "compare")
    program()


def quick(row: Row) -> Row:
    """A row for the tests: a quarter of the pixels."""
    width, height = row.resolution
    return replace(row, resolution=(width // 2, height // 2))


def main(arguments: Sequence[str] | None = None) -> int:
    """The command; see the top of this file."""
    parser = argparse.ArgumentParser(description="The variance of each way of sampling.")
    parser.add_argument("--seeds", type=int, default=24)
    parser.add_argument("--quick", action="store_true", help="a quarter of the pixels")
    parser.add_argument("--out", type=Path, default=ROOT / "build" / "variance")
    given = parser.parse_args(arguments)
    prepare()
    given.out.mkdir(parents=True, exist_ok=True)
    print(HEAD, end="")
    results = []
    for row in ROWS:
        results.append(measure(quick(row) if given.quick else row, given.seeds))
        print(line_of(results[-1]), end="", flush=True)
    path = given.out / "variance.md"
    about = f"Variance of a pixel's luminance over {given.seeds} seeds, equal samples a pixel.\n\n"
    path.write_text(about + HEAD + "".join(map(line_of, results)), encoding="utf-8")
    missed = sum(not m.fine for m in results)
    print(f"{path.relative_to(ROOT) if path.is_relative_to(ROOT) else path}: ", end="")
    print(f"{missed} not met" if missed else "all met")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
