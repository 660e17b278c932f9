/* box.h - axis-aligned bounding boxes: the type and its arithmetic.
 *
 * How a ray meets a box is a module of its own: accel/aabb.h. */
#ifndef RAYBOOK_BASE_BOX_H
#define RAYBOOK_BASE_BOX_H

#include "base/vec.h"

/* All points p with lower <= p <= upper, component by component. A box may
 * be flat (lower.y == upper.y): it is then a rectangle, not empty. */
typedef struct {
    vec3 lower, upper;
} aabb;

/* The empty box: the neutral element of aabb_union. */
static inline aabb aabb_empty(void)
{
    aabb box = {{INFINITY, INFINITY, INFINITY},
                {-INFINITY, -INFINITY, -INFINITY}};
    return box;
}

/* Not vec3_min and vec3_max, which mind NaN at the price of a call for each
 * component: nothing here is NaN. */
static inline vec3 aabb_lesser(vec3 a, vec3 b)
{
    return vec3_make(a.x < b.x ? a.x : b.x, a.y < b.y ? a.y : b.y,
                     a.z < b.z ? a.z : b.z);
}

static inline vec3 aabb_greater(vec3 a, vec3 b)
{
    return vec3_make(a.x > b.x ? a.x : b.x, a.y > b.y ? a.y : b.y,
                     a.z > b.z ? a.z : b.z);
}

static inline aabb aabb_union(aabb a, aabb b)
{
    aabb box = {aabb_lesser(a.lower, b.lower), aabb_greater(a.upper, b.upper)};
    return box;
}

static inline aabb aabb_include(aabb a, vec3 point)
{
    aabb box = {aabb_lesser(a.lower, point), aabb_greater(a.upper, point)};
    return box;
}

/* Halves before it adds: corners near the end of a float's range must not
 * overflow. */
static inline vec3 aabb_centroid(aabb a)
{
    return vec3_add(vec3_scale(a.lower, 0.5f), vec3_scale(a.upper, 0.5f));
}

/* Surface area; 0 for the empty box. */
static inline float aabb_area(aabb a)
{
    vec3 d = vec3_sub(a.upper, a.lower);
    if (!(d.x >= 0.0f && d.y >= 0.0f && d.z >= 0.0f))
        return 0.0f;
    return 2.0f * (d.x * d.y + d.y * d.z + d.z * d.x);
}

#endif
