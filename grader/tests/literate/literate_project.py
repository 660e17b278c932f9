"""A miniature checkout with every kind of marker, for the tests of the literate core."""

from __future__ import annotations

from pathlib import Path

DISC_C = """\
/* disc.c - where a ray meets a disc. */
#include "shapes/disc.h"

#include <assert.h>

//> disc.helper: Measure against the radius
#ifndef TODO_disc_hit
static bool inside_radius(float x, float y, float radius)
{
    return x * x + y * y <= radius * radius;
}
#endif
//< disc.helper

//> disc.hit: Intersect a ray with a disc
bool disc_hit(const struct disc *d, const struct ray *r, float *t)
{
    //> disc.hit.plane: Find where the ray crosses the plane
    assert(d->radius > 0.0f);
#ifndef TODO_disc_hit
    float t_plane = (d->height - r->origin[2]) / r->direction[2];
    //> disc.hit.point: Is the point inside?
    float x = r->origin[0] + t_plane * r->direction[0];
    float y = r->origin[1] + t_plane * r->direction[1];
    //< disc.hit.point

    if (!inside_radius(x, y, d->radius))
        return false;
    *t = t_plane;
    return true;
#else
    /* TODO(disc_hit): find t, then compare with the radius. */
    //> disc.hit.stub: Say that nothing is hit
    (void)d, (void)r, (void)t;
    return false;
    //< disc.hit.stub
#endif
    //< disc.hit.plane
}
//< disc.hit


//> disc.area: Its area
float disc_area(const struct disc *d)
{
    return DISC_PI * d->radius * d->radius;
}
//< disc.area
"""

DISC_C_STUDENT = """\
/* disc.c - where a ray meets a disc. */
#include "shapes/disc.h"

#include <assert.h>

bool disc_hit(const struct disc *d, const struct ray *r, float *t)
{
    /* Find where the ray crosses the plane. */
    assert(d->radius > 0.0f);
    /* TODO(disc_hit): find t, then compare with the radius. */
    /* Say that nothing is hit. */
    (void)d, (void)r, (void)t;
    return false;
}

float disc_area(const struct disc *d)
{
    return DISC_PI * d->radius * d->radius;
}
"""

DISC_C_REVEALED = """\
/* disc.c - where a ray meets a disc. */
#include "shapes/disc.h"

#include <assert.h>

static bool inside_radius(float x, float y, float radius)
{
    return x * x + y * y <= radius * radius;
}

bool disc_hit(const struct disc *d, const struct ray *r, float *t)
{
    /* Find where the ray crosses the plane. */
    assert(d->radius > 0.0f);
    float t_plane = (d->height - r->origin[2]) / r->direction[2];
    /* Is the point inside? */
    float x = r->origin[0] + t_plane * r->direction[0];
    float y = r->origin[1] + t_plane * r->direction[1];

    if (!inside_radius(x, y, d->radius))
        return false;
    *t = t_plane;
    return true;
}

float disc_area(const struct disc *d)
{
    return DISC_PI * d->radius * d->radius;
}
"""

DISC_H = """\
/* disc.h - a disc in a plane of constant height. */
#ifndef DISC_H
#define DISC_H

#include <stdbool.h>

//> disc.types: What a disc is
#define DISC_PI 3.14159265f
struct disc {
    float height, radius;
};
struct ray {
    float origin[3], direction[3];
};
//< disc.types

//> disc.contract: What it can be asked
bool disc_hit(const struct disc *d, const struct ray *r, float *t);
//>+ disc.types
float disc_area(const struct disc *d);
//< disc.types
//< disc.contract

#endif
"""

MEAN_C = """\
//> mean.pair: The mean of two numbers
float mean_pair(float a, float b)
{
#ifndef TODO_mean_pair
    return a + 0.5f * (b - a);
#else
    return a + 0.0f * b;
#endif
}
//< mean.pair
"""

ASSIGNMENT_01 = """\
# The first assignment.
title = "Disc"
owned = ["src/shapes/disc.c"]
todos = ["disc_hit"]

[[check]]
name = "public unit tests"

# Rays that only the grader has.
[[check]]
name = "secret rays"
hidden = true

[check.limits]
seconds = 3

[[check]]
name = "pictures"

[hidden]
seed = 12345
"""

ASSIGNMENT_01_PUBLIC = """\
# The first assignment.
title = "Disc"
owned = ["src/shapes/disc.c"]
todos = ["disc_hit"]

[[check]]
name = "public unit tests"

[[check]]
name = "pictures"
"""

MISTAKE = """\
title: forgets the square
hint: what is the unit of each side?
--- a/src/shapes/disc.c
+++ b/src/shapes/disc.c
@@ -8,3 +8,3 @@
 {
-    return x * x + y * y <= radius * radius;
+    return x * x + y * y <= radius; /* wrong by a factor */
 }
"""

ALTERNATIVE = """\
bool disc_hit(const struct disc *d, const struct ray *r, float *t)
{
    float rise_to_plane = d->height - r->origin[2];
    return hypotf(r->origin[0], rise_to_plane) < d->radius;
}
"""

HIDDEN_TEST = """\
#include "unity.h"
void test_grazing_rays(void)
{
    TEST_ASSERT_FALSE(hits_disc_at_grazing_angle(1e-7f));
}
"""

FILES = {
    "src/shapes/disc.c": DISC_C,
    "src/shapes/disc.h": DISC_H,
    "src/shapes/mean.c": MEAN_C,
    "assignments/01-disc/assignment.toml": ASSIGNMENT_01,
    "assignments/01-disc/test_disc.c": '#include "unity.h"\nint main(void) { return 0; }\n',
    "assignments/01-disc/handout.md": "# Discs\n",
    "assignments/01-disc/notes.md": "for instructors\n",
    "assignments/01-disc/hidden/test_grazing.c": HIDDEN_TEST,
    "assignments/01-disc/hidden/rays.txt": (
        "grazing the rim from below | 1 0 0 | 0 1 0\n0 0 0 | 1 0.25 1 | 0 1 0 | 2 2 2 | 0 inf\n"
    ),
    "assignments/01-disc/mistakes/README.md": "how often each of these mistakes was seen\n",
    "assignments/01-disc/hidden/expected.bin": "one two three\n",
    "assignments/01-disc/mistakes/no-square.patch": MISTAKE,
    "assignments/01-disc/alternatives/hypot.c": ALTERNATIVE,
    "assignments/02-mean/assignment.toml": (
        'owned = ["src/shapes/mean.c"]\ntodos = ["mean_pair"]\n'
    ),
    "assignments/02-mean/test_mean.c": "int main(void) { return 0; }\n",
    "assignments/handout/Makefile": "all:\n\t@echo student\n",
    "assignments/handout/README.md": "# For students\n",
    "assignments/handout/tools/view.sh": "echo view\n",
    "scenes/demo.json": '{"shapes": []}\n',
    ".setup/setup.sh": "#!/bin/sh\n",
    ".setup/packages.txt": "gcc\n",
    ".setup/requirements.lock": "numpy==1\n",
    ".clang-format": "BasedOnStyle: LLVM\n",
    ".gitignore": "/build/\n",
    "LICENSE": "MIT\n",
    "Makefile": "instructor:\n",
    "README.md": "# For instructors\n",
    "grader/grade.py": "pass\n",
    "docs/index.md": "# Book\n",
    "build/out.txt": "junk\n",
}


def write_project(root: Path, changes: dict[str, str] | None = None) -> Path:
    """Write the miniature checkout, with these files changed or added, and return `root`."""
    for name, text in {**FILES, **(changes or {})}.items():
        path = root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    return root
