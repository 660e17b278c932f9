"""Graded classes made directly, without grading: what the reports are made of, and at once.

    build/venv/bin/python grader/tests/reports/report_class.py DIR [STUDENTS]

writes the pages of a made-up class, to be looked at.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from contextlib import closing
from functools import cache
from pathlib import Path
from random import Random

import numpy as np

from raybook_grader.checks.result import CheckResult, Status, conclude
from raybook_grader.course import Assignment, Check, ImageCheck, load_course
from raybook_grader.database import Database
from raybook_grader.diagnosis import Diagnosis
from raybook_grader.grading.result import ModuleResult, from_checks, internal_error, missing
from raybook_grader.judge.facts import facts_of_judgement
from raybook_grader.judge.findings import BiasVerdict, Reason
from raybook_grader.judge.itp import colour_difference
from raybook_grader.judge.perceptual import PerceptualError, flip
from raybook_grader.judge.pixels import Image
from raybook_grader.judge.viewer import viewer_html
from raybook_grader.judge.viewing import viewing_of
from raybook_grader.reports import write_reports

CHECKOUT = Path(__file__).resolve().parents[3]
SIZE = 64

Results = Mapping[str, Mapping[str, ModuleResult | None]]
"""By submission and by the number of the assignment."""

_WORDS = """src/shapes/triangle.c: In function 'triangle_intersect':
src/shapes/triangle.c:41:9: warning: unused variable 'w' [-Wunused-variable]
   41 |   float w = 1.0f - u - v;
      |         ^"""
_CASES = (
    "ray 17 from (0, 0, 5) towards (0, 0, -1): expected t = 5, got no hit",
    "ray 240 from (0.25, 0.25, 1) towards (0, 0, -1): expected u = 0.25, got u = 0.5",
    "ray 1031 along an edge: expected one hit of the two triangles, got none",
    "ray 4000 from (1e6, 0, 0): expected t = 1e6, got t = 999999.9",
)


@cache
def assignments() -> tuple[Assignment, ...]:
    """The course's own."""
    return tuple(a for a in load_course(CHECKOUT).assignments if a.is_graded)


def write_class(out: Path, results: Results, of: Sequence[Assignment] | None = None) -> Path:
    """The pages of these results, and their database; returns the class page."""
    out.mkdir(parents=True, exist_ok=True)
    with closing(Database(out, "Raybook, autumn")) as database:
        keys = {
            (name, number): f"{name}/{number}" for name, own in results.items() for number in own
        }
        database.plan(of or assignments(), dict.fromkeys(results), keys)
        for name, own in results.items():
            for number, result in own.items():
                if result is not None:
                    database.store(f"{name}/{number}", result, final=True)
        return write_reports(database, out)


def module_pages(index: Path, student: str) -> list[Path]:
    """The pages of a student's modules."""
    return sorted((index.parent / "students" / student).glob("*.html"))


def made_up_class(students: int, seed: int, picture: str = "") -> Results:
    """Students of different skill; every verdict occurs in a class of two hundred."""
    random = Random(seed)
    ids = random.sample(range(10_000, 99_999), students)
    return {f"s{n}": _student(random, picture) for n in sorted(ids)}


def _student(random: Random, picture: str) -> dict[str, ModuleResult | None]:
    skill, last = random.betavariate(4, 2), random.choice([4, 8, 10, 11, 11, 11])
    return {
        a.number: _module(a, skill, random, picture) if i < last else missing(_STUB)
        for i, a in enumerate(assignments())
    }


_STUB = "still the stub that the course hands out"


def _module(a: Assignment, skill: float, random: Random, picture: str) -> ModuleResult:
    if random.random() < 0.002:
        return internal_error("the grader failed here (OSError)", "Traceback: OSError: disk full")
    luck = random.random()
    if luck < 0.08 * (1 - skill):
        return _unbuilt(a.checks)
    if luck < 0.3 * (1 - skill):
        return _ended(a.checks, random.choice(_ENDINGS))
    right = random.random() < skill
    checks = [passed(c, picture) if right or random.random() < 0.6 else wrong(c, random, picture)
              for c in a.checks]  # fmt: skip
    result = from_checks(checks)
    if any(check.status is Status.FAILED for check in checks):
        return ModuleResult(
            result.verdict, result.score, "", result.checks, "", diagnosis(random, a.number)
        )
    return result


_ENDINGS = (Status.CRASH, Status.TIMEOUT, Status.MEMORY, Status.FORBIDDEN)


def _unbuilt(checks: Sequence[Check]) -> ModuleResult:
    first = conclude(checks[0], Status.BUILD_ERROR, "it does not compile", words=_WORDS,
                     fingerprint="does not compile")  # fmt: skip
    rest = [conclude(c, Status.NOT_RUN, "not run, because there is no program") for c in checks[1:]]
    return from_checks([first, *rest])


def _ended(checks: Sequence[Check], status: Status) -> ModuleResult:
    message, kind = f"the program ended with: {status}", f"ends with {status}"
    ended = conclude(checks[-1], status, message, fingerprint=kind, words="free(): bad pointer")
    return from_checks([*(passed(c) for c in checks[:-1]), ended])


def diagnosis(random: Random, number: str) -> tuple[Diagnosis, ...]:
    """One or two known mistakes."""
    names = ("leaf-off-by-one", "far-child-first", "cosine-missing", "one-sided", "nan-passes")
    chosen = random.sample(names, random.choice([1, 1, 2]))
    hint = f"Think again about what happens at the boundary, as chapter {number} draws it."
    return tuple(
        Diagnosis(name, 0.9 / (i + 1), hint, "it fails in the same way in: hits match brute force")
        for i, name in enumerate(chosen)
    )


def passed(check: Check, picture: str = "") -> CheckResult:
    """A check with all of its points."""
    if isinstance(check, ImageCheck):
        message = "the picture converges to the reference (perceptual score 100 of 100)"
        return conclude(check, Status.PASSED, message, picture=picture)
    return conclude(check, Status.PASSED, "all 4096 cases are right")


def wrong(check: Check, random: Random, picture: str = "") -> CheckResult:
    """A check that fails in one of a few ways."""
    if isinstance(check, ImageCheck):
        return conclude(
            check, Status.FAILED, "the picture differs from the reference (perceptual score 46)",
            share=0.46, cases=("the image is 3.1 % too bright on average",), picture=picture,
            fingerprint="picture too bright, too dark or tinted",
        )  # fmt: skip
    count = random.randint(1, len(_CASES))
    return conclude(
        check, Status.FAILED, f"{random.randint(1, 400)} of 4096 cases are wrong",
        cases=tuple(random.sample(_CASES, count)),
        fingerprint=random.choice(("missed an edge", "t out of range", "wrong barycentrics")),
    )  # fmt: skip


def pictures(seed: int = 1) -> tuple[Image, Image]:
    """A reference and a noisy picture of it that is too bright on one side."""
    random = np.random.default_rng(seed)
    y, x = np.mgrid[0:SIZE, 0:SIZE] / (SIZE - 1.0)
    round_ = np.clip(1 - 6 * ((x - 0.5) ** 2 + (y - 0.45) ** 2), 0, None)
    grey = 0.05 + 0.25 * y + round_
    reference = (grey[..., None] * [0.9, 0.7, 0.5]).astype(np.float32)
    noise = random.normal(1, 0.02, (SIZE, SIZE, 1))
    test = (reference * noise * np.where(x > 0.6, 1.1, 1.0)[..., None]).astype(np.float32)
    return reference, test


@cache
def viewer() -> str:
    """The viewer of `pictures`."""
    reference, test = pictures()
    viewing = viewing_of(reference)
    value, error = flip(reference, test, viewing)
    colour = colour_difference(reference, test, viewing.white)
    bias = BiasVerdict("fail", (Reason("G", 0.031, "too bright"),), (), 1.1, (0.03, 0.03, 0.03))
    facts = facts_of_judgement(bias, PerceptualError(value, 0.01, error, colour))
    title = "The mean of 8 pictures of 16 samples a pixel, and the reference at 4096"
    return viewer_html(reference, test, error, title, delta_e=colour.map, facts=facts)


if __name__ == "__main__":
    count = int(sys.argv[2]) if len(sys.argv) > 2 else 200
    print(write_class(Path(sys.argv[1]), made_up_class(count, 1, viewer())))
