/* embree.h - Intel's Embree 3 as an acceleration structure: a witness.
 *
 * The boxes are a "user geometry": Embree builds its own tree of them and
 * walks through it by its own code, but what is in a box is tested by the
 * same leaf_test_fn as everywhere else. So a hit has the same bits as the
 * BVH's or it is a fault of one of the two, and two traversals that share
 * nothing check each other. It is not the fast way to use Embree: that is its
 * own triangle test, which the benchmark compares ours with.
 *
 * Embree walks in single precision and, for user geometries, without its
 * "robust" slab test; the boxes it is given are therefore wider than ours by
 * embree_slack of the largest coordinate. Boxes that reach beyond 1.8e18
 * are passed over by Embree.
 *
 * Only in builds with RAYBOOK_EMBREE, which build.mk defines where
 * <embree3/rtcore.h> is installed.
 *
 * Source: I. Wald, S. Woop, C. Benthin, G. Johnson, M. Ernst, "Embree: A
 * Kernel Framework for Efficient CPU Ray Tracing", ACM Transactions on
 * Graphics 33(4), 2014. */
#ifndef RAYBOOK_ACCEL_EMBREE_H
#define RAYBOOK_ACCEL_EMBREE_H

#include <stdbool.h>
#include <stdint.h>

#include "accel/leaf.h"
#include "base/box.h"

struct embree;

/* Builds a tree of boxes[0 .. count - 1]; leaves name primitive i as i. boxes
 * are read only now. Stops the program if memory runs out. Release with
 * embree_free. */
struct embree *embree_build(const aabb boxes[], uint32_t count);

/* See bvh_nearest and bvh_any. Any number of threads may ask. */
bool embree_nearest(const struct embree *e, ray *r, leaf_test_fn *test,
                    const void *context, void *hit);
bool embree_any(const struct embree *e, ray *r, leaf_test_fn *test,
                const void *context, void *hit);

/* NULL is fine. */
void embree_free(struct embree *e);

#endif
