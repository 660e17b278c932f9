"""Assignment 05 judges rightly: what its probes see, and in which words.

What all assignments have in common is tested in test_every_probe.py and test_museum.py.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from probe_bench import ROOT, Bench, assignment_of, bench_fixture, name_of, right_modules

ASSIGNMENT = assignment_of("05")
RIGHT = right_modules(ASSIGNMENT)
DIRECT, POINT = (ROOT / path for path in ASSIGNMENT.owned)
FADING, SURFACES, SHADOWS, ENDS = [
    "point light fades with distance",
    "light on surfaces",
    "shadows",
    "shadows near both ends",
]
UNIT = "public unit tests"

bench = bench_fixture(ASSIGNMENT)


@pytest.mark.parametrize("seed", [100, 101])
@pytest.mark.parametrize("module", [m for m in RIGHT if m.name == DIRECT.name], ids=name_of)
def test_right_modules_pass_with_other_seeds(bench: Bench, module: Path, seed: int) -> None:
    for check in (SURFACES, SHADOWS, ENDS):
        assert bench.failures(module, check, seed=seed) == [], check


@pytest.mark.parametrize(
    "todo, module, expected",
    [
        ("direct_light", DIRECT, {UNIT, SURFACES, SHADOWS, ENDS}),
        ("point_light", POINT, {UNIT, FADING}),
    ],
)
def test_half_a_solution_earns_its_half(
    bench: Bench, todo: str, module: Path, expected: set[str]
) -> None:
    assert bench.failing(module, "gcc", ("-O2", f"-DTODO_{todo}")) == expected


MUTANTS = {
    "0.01 % brighter lamp": ("(4.0f * PI)", "(3.9995f * PI)", POINT, FADING),
    "one colour of flux": ("rgb_scale(flux,", "rgb_scale(rgb_grey(flux.g),", POINT, FADING),
    "0.1 % brighter": ("cosine / s->pdf", "1.001f * cosine / s->pdf", DIRECT, SURFACES),
    "viewer for light": ("dot(s->direction,", "dot(v->outgoing,", DIRECT, SURFACES),
    "directions exchanged": (
        "v->outgoing,\n                                  s->direction",
        "s->direction,\n                                  vec3_negate(v->outgoing)",
        DIRECT,
        SURFACES,
    ),
    "one colour of light": ("s->radiance)", "rgb_grey(s->radiance.r))", DIRECT, SURFACES),
    "no colour of paint": ("mul(scattered, ", "mul(rgb_grey(scattered.g), ", DIRECT, SURFACES),
    "at most one": ("cosine / s->pdf", "fminf(1.0f, cosine / s->pdf)", DIRECT, SURFACES),
    "never hidden": ("|| hidden(scene, v, s)", "|| !hidden", DIRECT, SHADOWS),
    "nearly black": (
        "return rgb_grey(0.0f)",
        "return rgb_grey(rgb_is_black(scattered) ? 0.0f : 1e-6f)",
        DIRECT,
        SHADOWS,
    ),
    "a shorter way": (
        "v->surface, s->target",
        "v->surface,\n vec3_step(s->target, -1e-4f, vec3_sub(s->target, v->surface.position))",
        DIRECT,
        ENDS,
    ),
    "a longer way": (
        "v->surface, s->target",
        "v->surface,\n vec3_step(s->target, 1e-4f, vec3_sub(s->target, v->surface.position))",
        DIRECT,
        ENDS,
    ),
    "changes the sample": (
        "    float cosine",
        "    ((struct light_sample *)s)->pdf = 1.0f;\n    float cosine",
        DIRECT,
        SURFACES,
    ),
}


@pytest.mark.parametrize("mutant", MUTANTS)
def test_small_faults_are_found(bench: Bench, mutant: str, tmp_path: Path) -> None:
    old, new, module, check = MUTANTS[mutant]
    flags = ("-O1", "-Wno-address", "-Wno-error")
    assert bench.failures(bench.mutant(old, new, tmp_path, module), check, "gcc", flags)


# --- The cases --------------------------------------------------------------------------------


DARK = {  # the part of a label before its ":", and whether such a way is blocked
    "between": True, "between, a light without end": True, "below": False, "beside": False,
    "beyond": False, "beyond, a light without end": True, "beside, a light without end": False,
    "below, a light without end": False, "around the lamp": True, "around the surface": True,
    "just before the lamp": True, "just behind the lamp": False, "lamp on a wall": False,
    "lamp on a ball": False, "behind a ball": True, "just above the surface": True,
    "just below the surface": False,
}  # fmt: skip


@pytest.mark.parametrize("check", [SHADOWS, ENDS])
def test_the_oracle_agrees_with_how_a_case_was_made(bench: Bench, check: str) -> None:
    """The answer is worked out from the record; the label says what was meant."""
    context = bench.cases(check).context
    kinds = [case.label.split(":")[0] for case in context.cases]
    for kind, case, answer in zip(kinds, context.cases, context.answers, strict=True):
        if DARK.get(kind):
            assert not answer.radiance.any(), case.tell()
    lit = [answer.radiance.any() for answer in context.answers]
    free = [DARK.get(kind) is False for kind in kinds]
    assert np.mean(lit, where=free) > 0.6, "black are only those that the surface turns away"
    assert sum(kind in DARK for kind in kinds) > 0.98 * len(kinds)


def test_a_floor_in_numbers(bench: Bench) -> None:
    """Three answers worked out by hand: albedo / pi x radiance x cosine."""
    context = bench.cases(SURFACES).context
    known = {case.label: a.radiance for case, a in zip(context.cases, context.answers, strict=True)}
    full = np.array([0.5, 0.25, 1.0]) * np.array([2.0, 4.0, 8.0]) / np.pi
    for label, share in (("straight above", 1), ("slanting", 0.6), ("density 4", 0.25)):
        assert np.allclose(known[label], share * full, rtol=1e-6, atol=0)
    assert not known["lamp behind the floor"].any()


@pytest.mark.parametrize("check", [SURFACES, SHADOWS, ENDS])
def test_light_and_shadow_are_both_common(bench: Bench, check: str) -> None:
    answers: Any = bench.cases(check).context.answers
    dark = np.mean([not answer.radiance.any() for answer in answers])
    assert 0.2 < dark < 0.65
    allowed = [np.max(a.tolerance) / np.max(a.radiance) for a in answers if a.radiance.any()]
    assert np.median(allowed) < 1.5e-4 and max(allowed) < 1.2e-3


# --- Words ------------------------------------------------------------------------------------


def test_a_failure_is_told_in_words(bench: Bench, tmp_path: Path) -> None:
    mutant = bench.mutant("    if (s->infinite)", "    if (true)", tmp_path, DIRECT)
    failures = bench.failures(mutant, ENDS)
    simplest = max(failures, key=lambda failure: failure.simplicity)
    assert simplest.fingerprint == "black where there is light: just behind the lamp"
    assert simplest.message == (
        "just behind the lamp: a floor (one-sided, colour (0.5, 0.25, 1)), seen from (0, 3, 4) "
        "along (0, -3, -4), a wall 0.1 above the lamp; a light in direction (0, 1, 0) at "
        "(0, 2, 0), radiance (2, 4, 8), pdf 1: expected (0.31830987, 0.31830987, 2.546479), "
        "got (0, 0, 0)"
    )
