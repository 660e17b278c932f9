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
 * - direction need not have length one, and no size of box is special.
 *
 * Accuracy asked for: t_enter and t_exit within 1e-5 of themselves. Where the
 * ray misses or touches the box, or an end of the range, by less than that,
 * either answer is right; where rounding plays no part, as for small whole
 * numbers, touching counts. One thing is sure: a box whose inside the ray
 * crosses, or a flat one whose rectangle it crosses, is never missed, however
 * short the way through it. A BVH would lose triangles.
 *
 * Not asked: what comes of a NaN, of a direction whose components are all
 * zero, of corners or origins that are infinite, of other boxes with
 * lower > upper. Any answer will do then, but a crash will not.
 *
 * Called many million times: no allocation, no printing, no state.
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
