/* beam.h - a ray as thick as rounding can make it.
 *
 * The exact test of a triangle costs more than finding out that most need
 * none. So boxes and triangles are first tried by a quick test in single
 * precision that may say "perhaps" too often but never "no" too often: it asks
 * whether they meet a beam around the ray that is wider than all the rounding
 * errors of the test. What passes is then asked exactly.
 *
 * Let u = 2^-24, o the origin's largest coordinate, and R the reach: the
 * largest coordinate difference between the origin and a point of the tree's
 * box. In units of length, the quick tests are off by no more than
 *   2 u o + 5 u R for a plane of a box,
 *   7 u R         for a corner of a triangle, seen along the ray,
 * plus 2 u R, since triangle_intersect accepts a little beyond the edges. The
 * beam is 8 u (o + R) wide for boxes and 16 u R for triangles, and by a margin
 * wider where the ray itself is not exact. */
#ifndef RAYBOOK_ACCEL_BEAM_H
#define RAYBOOK_ACCEL_BEAM_H

#include <stdbool.h>

#include "base/box.h"
#include "base/ray.h"

/* Axes are numbered 0, 1, 2; planes of a box 2 axis for its lower side and
 * 2 axis + 1 for its upper one. */
struct beam {
    /* The slab of an axis lies between t = near_plane inverse + enter and
     * t = far_plane inverse + leave. */
    int near_plane[3], far_plane[3];
    float inverse[3], enter[3], leave[3];
    /* Along z, the direction's largest axis, the beam goes straight: a point
     * p, relative to the origin, is seen at (p.x - shear_x p.z,
     * p.y - shear_y p.z), at t = p.z scale_z. */
    int x, y, z;
    float origin[3];
    float shear_x, shear_y, scale_z;
    float width;   /* for triangles */
    float width_t; /* the same as a difference of t */
};

/* How far the ray may be from where it should be: factor (o + R) + length. */
struct beam_margin {
    float factor, length;
};

/* Prepares the quick tests of things in the box. False: the ray or the box is
 * so large (beyond 2^60), or the direction so short, that single precision
 * might overflow. */
bool beam_make(const ray *r, const aabb *box, struct beam_margin margin,
               struct beam *out);

#endif
