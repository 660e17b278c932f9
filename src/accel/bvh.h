/* bvh.h - assignment 03: a tree of boxes over many primitives.
 *
 * A bounding volume hierarchy answers "what does this ray hit?" without
 * asking every primitive: a box that the ray misses rules out all that is in
 * it. The tree knows boxes only; what is in a leaf is tested by the caller. */
#ifndef RAYBOOK_ACCEL_BVH_H
#define RAYBOOK_ACCEL_BVH_H

#include <stdbool.h>
#include <stdint.h>

#include "accel/leaf.h"
#include "base/box.h"
#include "base/ray.h"

enum {
    BVH_MAX_DEPTH = 64, /* the root has depth 1 */
    BVH_MAX_LEAF = 32   /* primitives */
};

/* count > 0: a leaf; it holds the primitives order[first] ..
 *            order[first + count - 1].
 * count = 0: an inner node; its children are nodes[first] and
 *            nodes[first + 1].
 * box encloses everything below. */
struct bvh_node {
    aabb box;
    uint32_t first;
    uint32_t count;
};

/* nodes[0] is the root; node_count is 0 when there is nothing to hit. */
struct bvh {
    const struct bvh_node *nodes;
    uint32_t node_count;
};

/* Builds the tree.
 *
 * boxes: the primitives' boxes. Coordinates are finite and not beyond 1e15 in
 *   size, lower <= upper; a box may be flat or a point, boxes may coincide.
 * primitive_count: 0 to 10 million and more.
 * nodes: room for 2 primitive_count - 1 nodes (1 when primitive_count <= 1),
 *   owned by the caller.
 * order: room for primitive_count numbers, owned by the caller; becomes a
 *   permutation of 0 .. primitive_count - 1.
 * Returns the number of nodes used; 0 for no primitives.
 *
 * - Each primitive is in exactly one leaf, each node but the root has
 *   exactly one parent, and a node's box holds the boxes below it.
 * - No leaf is deeper than BVH_MAX_DEPTH, whatever the input: equal
 *   centroids, a million equal boxes, sizes from 1e-15 to 1e15. Neither is
 *   any recursion.
 * - No leaf holds more than BVH_MAX_LEAF primitives, equal ones or not.
 * - The same boxes give the same tree, whatever nodes and order held before
 *   and whatever was built before.
 * - For full marks the split is chosen by the surface area heuristic.
 *
 * Source: I. Wald, "On fast Construction of SAH-based Bounding Volume
 * Hierarchies", IEEE Symposium on Interactive Ray Tracing, 2007. */
uint32_t bvh_build(const aabb boxes[], uint32_t primitive_count,
                   struct bvh_node nodes[], uint32_t order[]);

/* The nearest hit within [r->t_min, r->t_max], both ends included. Calls
 * test(context, first, count, r, hit) for leaves that may hold it; each test
 * lowers r->t_max to about the hit, so what lies beyond can be skipped.
 * Returns whether any test returned true.
 *
 * - The tree is any that keeps the rules above, whoever built it.
 * - Boxes are tested with aabb_test (accel/aabb.h), which counts them. Nothing
 *   below a box that the ray misses is tested.
 * - context, r and hit are handed on as they are. *hit is the tests' alone to
 *   write, and of *r they change t_max only.
 * - Nothing is kept outside of the call: any number of threads may walk at
 *   once, and a test may itself walk a tree before it answers. */
bool bvh_nearest(const struct bvh *tree, ray *r, leaf_test_fn *test,
                 const void *context, void *hit);

/* Is there any hit at all? Returns true as soon as one test does: no other
 * test is called after it. All else is as for bvh_nearest. */
bool bvh_any(const struct bvh *tree, ray *r, leaf_test_fn *test,
             const void *context, void *hit);

#endif
