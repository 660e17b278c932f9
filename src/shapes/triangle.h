/* triangle.h - assignment 01: where a ray meets a triangle.
 *
 * Picture: a triangle with corners p0, p1, p2. Every point of it is
 *
 *     p = b0 p0 + b1 p1 + b2 p2,   b0 + b1 + b2 = 1,   b0, b1, b2 >= 0.
 *
 * The three weights are its barycentric coordinates; b0 follows from the
 * other two, so a hit stores only b1 and b2. */
#ifndef RAYBOOK_SHAPES_TRIANGLE_H
#define RAYBOOK_SHAPES_TRIANGLE_H

#include <stdbool.h>

#include "base/ray.h"
#include "shapes/surface.h"

struct triangle_hit {
    float t;      /* the hit is at origin + t direction */
    float b1, b2; /* weights of p1 and p2; p0 has 1 - b1 - b2 */
};

/* Does the ray meet the triangle p[0], p[1], p[2]?
 *
 * On a hit: stores t and the barycentric coordinates and returns true.
 * On a miss: returns false and leaves *hit as it was.
 *
 * - Both sides count: the triangle is not culled by its winding.
 * - The range is closed: t_min <= t <= t_max counts; t outside does not.
 *   t_max may be INFINITY. The function never changes the ray.
 * - Edges and corners belong to the triangle: b1 = 0, b2 = 0 and
 *   b1 + b2 = 1 are hits.
 * - A ray in the triangle's plane, or parallel to it, misses.
 * - A triangle without area (equal corners, corners in a line) is never
 *   hit, and neither is one with a corner that is not finite. Where rounding
 *   hides whether three corners are in a line, either answer is right.
 * - No size is special: a triangle of 1e-4 metres is hit as surely as one of
 *   1e4. A fixed "epsilon" that the determinant must exceed breaks that.
 * - direction need not have length one; its zeros are allowed.
 *
 * Accuracy asked for: t within 1e-4 relative plus what a wrong last digit of
 * the input can do; b1, b2 within 1e-4 for well-shaped triangles. Within that
 * of an edge or of the range's ends either answer is right; where rounding
 * plays no part, as for small whole numbers, edges and ends count.
 *
 * Called many million times: no allocation, no printing, no state.
 *
 * Source: T. Moller and B. Trumbore, "Fast, Minimum Storage Ray-Triangle
 * Intersection", Journal of Graphics Tools 2(1), 1997. Any right method will
 * do. */
bool triangle_intersect(const vec3 p[3], const ray *r,
                        struct triangle_hit *hit);

/* How the point moves with the texture coordinates.
 *
 * Given corners p and their texture coordinates uv, finds the two vectors
 * with
 *
 *     p[i] - p[0] = (uv[i].x - uv[0].x) dp_du + (uv[i].y - uv[0].y) dp_dv
 *
 * for i = 1, 2, stores them and returns true. They lie in the triangle's
 * plane and in general are neither of length one nor at right angles.
 * Accuracy asked for: within 1e-4 of each vector's length, plus what a wrong
 * last digit of the input can do.
 *
 * When the texture coordinates have no area (all equal, or in a line: the
 * 2x2 system has a determinant of exactly 0) or the solution is not finite,
 * returns false and leaves *dp_du and *dp_dv as they were; the framework then
 * picks some frame of the plane. */
bool triangle_uv_differentials(const vec3 p[3], const vec2 uv[3], vec3 *dp_du,
                               vec3 *dp_dv);

#endif
