/* placement.h - a mesh, and the tree over it, put somewhere else.
 *
 * A mesh that a scene shows a thousand times needs one tree only, in the
 * mesh's own (local) space: a ray is moved there instead. It keeps its t,
 * since an affine map keeps proportions along a line:
 *
 *     world = A local + m,   origin' = A^-1 (origin - m),
 *     direction' = A^-1 direction.
 *
 * The moved ray is rounded, and so are the corners of a mesh that was moved
 * for good. The beam of the local ray (beam.h) is therefore made wider by what
 * both can amount to; what passes is asked exactly, with the ray as it was and
 * with the very corners that mesh_transform makes. So a placed mesh is hit as
 * its moved copy would be, to the last bit.
 *
 * By how much? Lengths are largest coordinates, |A| is the largest sum of the
 * sizes in a row, u = 2^-24. Let o be the size of the local origin, R its
 * reach (beam.h), P the largest coordinate of the mesh, so that P <= o + R,
 * and k = |A| |A^-1|, which is at least 1. In local units:
 *   5 u k o              the moved origin: a difference, the entry of the
 *                        inverse, a product and two sums are rounded;
 *   4 u k R              the moved direction, along the way to the hit;
 *   4 u (k P + |A^-1| |m|)  a corner, rounded in the world: a product and three
 *                        sums, brought back by A^-1;
 *   2 u k R              what triangle_intersect accepts beyond the edges: at
 *                        most 2 u times the reach in the world, |A| R.
 * Together that is less than 16 u k (o + R) + 8 u |A^-1| |m|. What is left of
 * the two factors is far more than products of roundings, the float k, and
 * underflow come to, as |A|, |A^-1| and the mesh's size lie between 2^-40 and
 * 2^40, and k is no more than 2^10. */
#ifndef RAYBOOK_ACCEL_PLACEMENT_H
#define RAYBOOK_ACCEL_PLACEMENT_H

#include <stdbool.h>
#include <stdint.h>

#include "accel/beam.h"
#include "base/box.h"
#include "base/ray.h"
#include "base/transform.h"

struct placement {
    struct transform to_world;
    bool mirrors;              /* the winding is turned then */
    uint32_t first_primitive;  /* number of the mesh's first triangle here */
    struct beam_margin margin; /* of the moved rays */
};

/* Fills *out for a mesh within a box of its own space. False: the map is so
 * uneven, or leads so far away for the mesh's size, that beams would be
 * too thick to be of use, or sizes are out of the range above. The mesh should
 * be moved for good then. */
bool placement_make(const struct transform *to_world, uint32_t first_primitive,
                    const aabb *local, struct placement *out);

/* The ray as the mesh sees it, about: the margin says how nearly. */
ray placement_ray(const struct placement *p, const ray *r);

/* The corners of a triangle in the world, to the bit as mesh_transform and
 * mesh_corners have them. */
void placement_corners(const struct placement *p, const vec3 local[3],
                       vec3 world[3]);

#endif
