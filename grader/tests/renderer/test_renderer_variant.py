"""`make VARIANT=dir`: a student's file in place of the reference's, and nothing else changes."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from renderer_runs import CORNELL, ROOT, SOURCE, program, read_exr, render, run, sphere

SMALL = ("--resolution", "40x40", "--spp", "3")

# Names that the rest of the program, or the C library, has too. Were they global, the linker
# would complain or, worse, the rest of the program would call these.
CLASHES = """
int aabb_intersect(void);
int aabb_intersect(void) { return 0; }
int bvh_nearest(int depth);
int bvh_nearest(int depth) { return depth > 0 ? bvh_nearest(depth - 1) : 0; }
float sqrtf(float x);
float sqrtf(float x) { return 0.0f * x; }
double strtod(const char *text, char **end);
double strtod(const char *text, char **end) { *end = (char *)text; return 7.0; }
void *calloc(unsigned long count, unsigned long size);
void *calloc(unsigned long count, unsigned long size) { (void)count, (void)size; return 0; }
const char *const accel_names[] = {"a student's own table", 0};
"""

BLIND = """
#include "shapes/triangle.h"

bool triangle_intersect(const vec3 p[3], const ray *r, struct triangle_hit *hit)
{
    (void)p, (void)r, (void)hit;
    return false;
}

bool triangle_uv_differentials(const vec3 p[3], const vec2 uv[3], vec3 *dp_du,
                               vec3 *dp_dv)
{
    (void)p, (void)uv, (void)dp_du, (void)dp_dv;
    return false;
}
"""


def variant(name: str, text: str) -> Path:
    """The program with this text as src/shapes/triangle.c. The folder's name is the variant's, so
    it is always the same one."""
    folder = ROOT / "build" / "test" / "variants" / name
    file = folder / "src" / "shapes" / "triangle.c"
    file.parent.mkdir(parents=True, exist_ok=True)
    if not file.is_file() or file.read_text() != text:
        file.write_text(text)
    return program(variant=str(folder))


@pytest.fixture(scope="module")
def clashing() -> Path:
    return variant("clashing-names", (SOURCE / "shapes" / "triangle.c").read_text() + CLASHES)


def test_a_variants_own_names_stay_its_own(tmp_path: Path, clashing: Path) -> None:
    reference = render(CORNELL, tmp_path, *SMALL)
    assert reference.any()
    assert np.array_equal(reference, render(CORNELL, tmp_path, *SMALL, binary=clashing))


def test_a_variant_is_told_by_its_image(tmp_path: Path, clashing: Path) -> None:
    render(CORNELL, tmp_path, *SMALL, binary=clashing)
    assert read_exr(tmp_path / "picture.exr").header["raybook:variant"] == "clashing-names"
    assert "(clashing-names)" in run("--version", cwd=tmp_path, binary=clashing).stdout


def test_the_variants_function_is_the_one_that_is_called(tmp_path: Path) -> None:
    blind = variant("blind-triangle", BLIND)
    balls = [sphere([x, 0.8, 0.4], 0.3, "white") for x in (-0.5, 0.5)]
    spheres = json.dumps({"objects": balls})
    want = render(CORNELL, tmp_path, *SMALL, "--override", spheres)
    got = render(CORNELL, tmp_path, *SMALL, "--override", spheres, binary=blind)
    assert want.any() and np.array_equal(want, got), "spheres are hit as before"
    box = render(CORNELL, tmp_path, *SMALL, binary=blind)
    assert not box[0].any() and not box[-1].any(), "ceiling and floor are meshes"
    assert box.any(), "the spheres in the box are not"
