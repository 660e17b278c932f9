/* aabb.h - assignment 02: where a ray passes through a box.
 *
 * The box type and its union, area and centroid are given: base/box.h. */
#ifndef RAYBOOK_ACCEL_AABB_H
#define RAYBOOK_ACCEL_AABB_H

#include <stdbool.h>

#include "base/box.h"
#include "base/counters.h"
#include "base/ray.h"

/* Does the part of the ray with t_min <= t <= t_max meet the box?
 *
 * On a hit: stores where it enters and leaves, clipped to the ray's range
 * (t_min <= *t_enter <= *t_exit <= t_max), and returns true.
 * On a miss: returns false; *t_enter and *t_exit may hold anything.
 *
 * - The box is closed: touching a face, an edge or a corner is a hit.
 * - A flat box (lower == upper along an axis) is a rectangle, not nothing.
 * - The origin may lie inside: *t_enter is then t_min.
 * - A box behind the origin, or beyond t_max, is a miss.
 * - A direction component may be +0 or -0. The ray then never crosses that
 *   axis's planes: it is between them (or on one of them: a hit) or outside
 *   (a miss). inverse_direction is infinite there, and 0 * infinity is NaN:
 *   mind what a comparison with NaN does.
 * - The empty box (aabb_empty) is never hit.
 *
 * A hit by less than the last few digits may be judged either way, but a box
 * must never be missed whose inside the ray crosses: a BVH would lose
 * triangles.
 *
 * Source: T. Kay and J. Kajiya, "Ray Tracing Complex Scenes", SIGGRAPH 1986;
 * T. Ize, "Robust BVH Ray Traversal", JCGT 2(2), 2013, for the rounding. */
bool aabb_intersect(const aabb *box, const ray *r, float *t_enter,
                    float *t_exit);

/* aabb_intersect, counted. Everything that walks through boxes calls this
 * one, so that two solutions' work can be compared. */
static inline bool aabb_test(const aabb *box, const ray *r, float *t_enter,
                             float *t_exit)
{
    counters_mine.boxes_tested++;
    return aabb_intersect(box, r, t_enter, t_exit);
}

#endif
