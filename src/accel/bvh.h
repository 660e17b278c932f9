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

enum { BVH_MAX_DEPTH = 64 }; /* the root has depth 1 */

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
 * boxes: the primitives' boxes; boxes[i] may be flat or a point, boxes may
 *   coincide, never NaN. primitive_count: 0 to 10 million and more.
 * nodes: room for 2 primitive_count - 1 nodes (1 when primitive_count <= 1),
 *   owned by the caller.
 * order: room for primitive_count numbers, owned by the caller; becomes a
 *   permutation of 0 .. primitive_count - 1.
 * Returns the number of nodes used; 0 for no primitives.
 *
 * - Each primitive is in exactly one leaf, each node but the root has
 *   exactly one parent, and a node's box holds the boxes below it.
 * - No leaf is deeper than BVH_MAX_DEPTH, whatever the input: equal
 *   centroids, a million equal boxes, sizes from 1e-6 to 1e6. Neither is any
 *   recursion.
 * - For full marks the split is chosen by the surface area heuristic.
 *
 * Source: I. Wald, "On fast Construction of SAH-based Bounding Volume
 * Hierarchies", IEEE Symposium on Interactive Ray Tracing, 2007. */
uint32_t bvh_build(const aabb boxes[], uint32_t primitive_count,
                   struct bvh_node nodes[], uint32_t order[]);

/* The nearest hit. Calls test(context, first, count, r, hit) for leaves that
 * may hold it; each test lowers r->t_max to about the hit, so what lies
 * beyond can be skipped. Returns whether any test returned true. */
bool bvh_nearest(const struct bvh *tree, ray *r, leaf_test_fn *test,
                 const void *context, void *hit);

/* Is there any hit at all? Returns true as soon as one test does. */
bool bvh_any(const struct bvh *tree, ray *r, leaf_test_fn *test,
             const void *context, void *hit);

#endif
