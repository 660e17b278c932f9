"""The committed statistics of the references: all there, none too many, and still true.

A picture fails by chance less than once in 1e8 runs: both looks would have to fail, each on
seeds of its own at a significance of 1e-4 divided by the number of tests.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from raybook_grader.checks.program import Workshop
from raybook_grader.checks.reference import References
from raybook_grader.checks.rendering import Picture
from raybook_grader.checks.shipping import pictures_of
from raybook_grader.course import load_course
from raybook_grader.judge.bias import MIN_SEEDS, Renders, verdict
from raybook_grader.judge.findings import BiasVerdict
from raybook_grader.judge.thresholds import ALL_TILES, THRESHOLDS
from raybook_grader.kit import load_kit
from raybook_grader.sandbox import Box

ROOT = Path(__file__).resolve().parents[3]
COURSE = load_course(ROOT)
PICTURES = pictures_of(COURSE.assignments)
MOST_BYTES = 20 << 20


@pytest.fixture(scope="module")
def references() -> References:
    return References(Workshop(COURSE, load_kit(ROOT / "build" / "kit"), Box()))


def test_exactly_the_pictures_of_the_checks_are_committed(references: References) -> None:
    """`make references` mends it."""
    there = {file.name for file in (ROOT / "grader" / "statistics").glob("*.npz")}
    assert there == {references.shipped_file(picture).name for picture in PICTURES}


def test_they_are_small(references: References) -> None:
    sizes = [references.shipped_file(picture).stat().st_size for picture in PICTURES]
    assert sum(sizes) < MOST_BYTES


@pytest.mark.parametrize("picture", PICTURES, ids=lambda p: Path(p.scene).stem)
def test_the_renderer_still_converges_to_them(picture: Picture, references: References) -> None:
    said = _verdict(references, picture, references.renders(picture))
    assert said.status == "pass", [reason.sentence for reason in said.reasons]


def test_a_light_of_two_per_cent_too_much_is_seen(references: References) -> None:
    picture = next(p for p in PICTURES if Path(p.scene).stem == "two-lights")
    render = references.renders(picture)
    said = _verdict(references, picture, lambda seeds: [1.02 * image for image in render(seeds)])
    assert said.status == "fail"


def _verdict(references: References, picture: Picture, render: Renders) -> BiasVerdict:
    return verdict(
        render,
        references.statistics(picture),
        picture.spp,
        tile_sizes=ALL_TILES,
        thresholds=THRESHOLDS,
        seeds=range(1, 1 + MIN_SEEDS),
        fresh_seeds=range(1001, 1001 + MIN_SEEDS),
    )
