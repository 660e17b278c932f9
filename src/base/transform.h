/* transform.h - affine maps of space. */
#ifndef RAYBOOK_BASE_TRANSFORM_H
#define RAYBOOK_BASE_TRANSFORM_H

#include <stdbool.h>

#include "base/vec.h"

/* Row by row, acting on column vectors: the translation is m[0][3], m[1][3],
 * m[2][3]; the last row is 0 0 0 1. inverse is kept beside it. */
struct transform {
    float m[4][4];
    float inverse[4][4];
};

struct transform transform_identity(void);

/* From 16 numbers, row by row. Returns false when the last row is not
 * 0 0 0 1 or the map squashes space flat (no inverse in float). */
bool transform_from_rows(const float rows[16], struct transform *out);

/* First a, then a step by offset. */
struct transform transform_translated(struct transform a, vec3 offset);

vec3 transform_point(const struct transform *t, vec3 p);
vec3 transform_direction(const struct transform *t, vec3 d);

/* By the inverse transpose, which keeps a normal at right angles to its
 * surface under any map. The length is not kept. */
vec3 transform_normal(const struct transform *t, vec3 n);

/* Does the map mirror space (determinant below zero)? */
bool transform_mirrors(const struct transform *t);

#endif
