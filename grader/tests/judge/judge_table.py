"""What the verdict on a picture says of light that is wrong, and of noise that is right.

    make judge-table

Every row is judged as an `image` check judges a student: the course's own scene, resolution and
samples, the reference's statistics, common random numbers; five times, each on seeds of its own.
A light that is 2 % too bright looks the same, and must fail; light that is sampled evenly instead
of where it comes from looks worse, and must not.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from raybook_grader.checks.program import Workshop
from raybook_grader.checks.reference import References
from raybook_grader.checks.rendering import PICTURE, picture_of
from raybook_grader.checks.scene import scene_binds
from raybook_grader.course import Course, ImageCheck, load_course
from raybook_grader.judge.exr import decode_exr
from raybook_grader.judge.image import ImageJudgement, judge_image
from raybook_grader.judge.pixels import Image
from raybook_grader.kit import load_kit
from raybook_grader.museum import exhibits_of
from raybook_grader.sandbox import Box, Limits

CHECKOUT = Path(__file__).resolve().parents[3]
LOOKS = 5
_LOOK = 10_000_000
"""Between the seeds of one look and the next; no grading comes this far."""
_FRESH = 1000
_LIMITS = Limits(wall_seconds=600, cpu_seconds=300, memory_bytes=4 << 30)
_TWO_PER_CENT = 1.02
_EMISSION = ("flux", "intensity", "radiance")

Scene = dict[str, Any]


@dataclass(frozen=True)
class Row:
    """A renderer to judge: the reference with settings ``changed``, or with an exhibit in it."""

    name: str
    scene: str
    biased: bool
    changed: Callable[[Scene], Scene] = lambda scene: {}
    exhibit: str = ""

    @property
    def wanted(self) -> tuple[str, ...]:
        return ("fail",) if self.biased else ("pass", "inconclusive")


def brighter(scene: Scene) -> Scene:
    """All that shines shines 2 % more."""
    changed: Scene = {key: _brighter(scene[key]) for key in ("lights", "objects") if key in scene}
    if "environment_map" in scene:
        changed["environment_map"] = {"scale": scene["environment_map"]["scale"] * _TWO_PER_CENT}
    return changed


def _brighter(value: Any) -> Any:
    if isinstance(value, list):
        return [_brighter(item) for item in value]
    if not isinstance(value, dict):
        return value
    return {
        key: [_TWO_PER_CENT * x for x in item] if key in _EMISSION else _brighter(item)
        for key, item in value.items()
    }


def even_lights(scene: Scene) -> Scene:
    return {"integrator": {"light_selection": "uniform"}}


def plain_random(scene: Scene) -> Scene:
    return {"sampler": {"type": "independent"}}


def random_walk(scene: Scene) -> Scene:
    """One bounce, by the cosine alone: light is met by chance."""
    return {"integrator": {"type": "path", "profile": "RW", "max_depth": 1, "rr_threshold": 0}}


_LAMPS = "scenes/test/several-lights.json"
_AREA = "scenes/test/lamp-near-floor.json"
_SKY = "scenes/test/asymmetric-environment.json"

TABLE = (
    Row("every light +2 %", _LAMPS, True, brighter),
    Row("every light +2 %", _AREA, True, brighter),
    Row("every light +2 %", _SKY, True, brighter),
    Row("lights picked evenly, not by their power", _LAMPS, False, even_lights),
    Row("samples fall anywhere, not in strata", _LAMPS, False, plain_random),
    Row("the lamps are hit by chance, not sampled", _AREA, False, random_walk),
    Row("directions picked evenly, not by the map", _SKY, False, exhibit="09/even-directions"),
)


class Table:
    """Judges rows; what the course and the kit hold is read once."""

    def __init__(self) -> None:
        self._course = load_course(CHECKOUT)
        self._workshop = Workshop(self._course, load_kit(CHECKOUT / "build" / "kit"), Box())
        self._references = References(self._workshop)
        self._program = cache(self._link)

    def judge(self, row: Row, look: int) -> ImageJudgement:
        check = image_check(self._course, row.scene)
        picture = picture_of(check)
        seeds = range(_LOOK * (1 + look), _LOOK * (1 + look) + check.seeds)
        return judge_image(
            lambda at: [self._render(row, check, seed) for seed in at],
            self._references.statistics(picture),
            check.spp,
            seeds=seeds,
            fresh_seeds=[seed + _FRESH for seed in seeds],
            reference_renders=self._references.renders(picture),
        )

    def _render(self, row: Row, check: ImageCheck, seed: int) -> Image:
        scene = json.loads((CHECKOUT / row.scene).read_text(encoding="utf-8"))
        override = json.dumps(row.changed(scene))
        done = self._workshop.box.run(
            ["/program", *picture_of(check).arguments(seed), "--override", override],
            inputs={"/program": self._program(row.exhibit)},
            binds=scene_binds(CHECKOUT, row.scene),
            collect=[PICTURE],
            limits=_LIMITS,
        )
        assert done.ok, done.stderr.decode("utf-8", "replace")
        return decode_exr(done.files[PICTURE]).pixels

    def _link(self, exhibit: str) -> bytes:
        """The renderer, with an exhibit's module in it if one is named."""
        if not exhibit:
            return self._workshop.renderer()
        assignment = self._course.assignment(exhibit.split("/")[0])
        found = {e.name: e for e in exhibits_of(CHECKOUT, assignment)}[exhibit]
        return self._workshop.renderer(self._workshop.compile_module(assignment, found.files))


def image_check(course: Course, scene: str) -> ImageCheck:
    """The check that judges students by this scene."""
    checks = (check for assignment in course.assignments for check in assignment.checks)
    return next(c for c in checks if isinstance(c, ImageCheck) and c.scene == scene)


def lines(row: Row, judgements: Sequence[ImageJudgement]) -> Iterator[str]:
    """A row in words."""
    said = [judgement.bias.status for judgement in judgements]
    good = sum(status in row.wanted for status in said)
    counts = ", ".join(f"{said.count(status)} {status}" for status in dict.fromkeys(said))
    yield f"{row.name}, {Path(row.scene).stem}"
    yield f"    {counts}; {good} of {len(said)} as wanted ({' or '.join(row.wanted)})"
    noise = [j.bias.noise_ratio for j in judgements if j.bias.noise_ratio is not None]
    yield f"    a sample's variance is {min(noise):.2g} to {max(noise):.2g} times the reference's"
    sentences = [reason.sentence for j in judgements for reason in j.bias.reasons]
    if sentences:
        yield f"    {sentences[0]}"


def main() -> int:
    parser = argparse.ArgumentParser(description="Judges biased and noisy renderers.")
    parser.add_argument("--looks", type=int, default=LOOKS)
    looks = parser.parse_args().looks
    table = Table()
    bad = 0
    for row in TABLE:
        judgements = [table.judge(row, look) for look in range(looks)]
        bad += sum(judgement.bias.status not in row.wanted for judgement in judgements)
        print("\n".join(lines(row, judgements)), flush=True)
    print(f"{len(TABLE) * looks - bad} of {len(TABLE) * looks} verdicts as wanted")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
