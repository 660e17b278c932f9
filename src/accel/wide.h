/* wide.h - a tree with eight children a node and eight triangles a leaf.
 *
 * A processor computes eight floats at once as fast as one. A node therefore
 * holds the boxes of eight children side by side, a leaf the corners of eight
 * triangles, and both are tested in one go, by plain loops of eight that the
 * compiler turns into such instructions.
 *
 * What is quick is a filter only (beam.h): every triangle that the ray may
 * hit is confirmed by triangle_intersect, so that the answers are those of
 * any other structure to the last bit.
 *
 * Source: I. Wald, C. Benthin, S. Boulos, "Getting Rid of Packets: Efficient
 * SIMD Single-Ray Traversal using Multi-branching BVHs", IEEE Symposium on
 * Interactive Ray Tracing, 2008; H. Dammertz, J. Hanika, A. Keller, "Shallow
 * Bounding Volume Hierarchies for Fast SIMD Ray Tracing of Incoherent Rays",
 * Computer Graphics Forum 27(4), 2008. */
#ifndef RAYBOOK_ACCEL_WIDE_H
#define RAYBOOK_ACCEL_WIDE_H

#include <stdbool.h>
#include <stdint.h>

#include "accel/leaf.h"
#include "accel/nearest.h"
#include "accel/placement.h"
#include "base/box.h"
#include "base/ray.h"

enum {
    WIDE = 8,           /* children of a node, lanes of a pack */
    WIDE_MAX_DEPTH = 64 /* nodes from the root down to a leaf */
};

/* A child is a node's index, or a pack's together with WIDE_LEAF. */
#define WIDE_LEAF 0x80000000u
#define WIDE_OTHER 0x40000000u /* a leaf of one that is no triangle */
#define WIDE_INDEX 0x3fffffffu

/* planes[2 axis] and planes[2 axis + 1] are the lower and the upper sides of
 * the children's boxes. A missing child's box is empty (aabb_empty). */
struct wide_node {
    float planes[6][WIDE];
    uint32_t child[WIDE];
};

/* corner[i][axis][lane] of the triangle primitive[lane]. The corners of an
 * empty lane are NaN and its primitive is NO_PRIMITIVE. What is no triangle
 * stands in the first lane of a pack of its own, with corners that are NaN. */
struct wide_pack {
    float corner[3][3][WIDE];
    uint32_t primitive[WIDE];
};

struct wide {
    const struct wide_node *nodes;
    const struct wide_pack *packs;
    uint32_t node_count, pack_count;
    uint32_t root; /* like a child */
    aabb box;      /* of everything; empty when there is nothing */
    void *memory;  /* that nodes and packs lie in */
};

/* What a tree is built over: count primitives, fewer than 2^30. Both functions
 * may be called by several threads at once. */
struct wide_source {
    uint32_t count;
    const uint32_t *numbers; /* of the primitives; NULL: 0 .. count - 1 */
    const void *context;
    /* The corners of a primitive, or false if it is no triangle. NULL: none
     * of them is one. */
    bool (*corners)(const void *context, uint32_t primitive, vec3 corners[3]);
    /* The box of a primitive that is no triangle. As for bvh_build: finite,
     * and perhaps flat. */
    aabb (*box)(const void *context, uint32_t primitive);
};

/* Builds a tree, by as many threads as OpenMP gives. The same primitives give
 * the same tree, to the last bit, whatever their number. Release with
 * wide_free. */
struct wide wide_build(const struct wide_source *source);

void wide_free(struct wide *tree);

/* The nearest hit, and whether there is any, as bvh_nearest and bvh_any of
 * bvh.h. Triangles are tested here; of any other primitive,
 * test(context, primitive, 1, r, hit) is asked. hit points to a struct
 * nearest if there are triangles.
 *
 * Eight boxes count as tested for every node visited and eight primitives for
 * every pack, since that is the work done, whether a lane is in use or not. */
bool wide_nearest(const struct wide *tree, ray *r, leaf_test_fn *test,
                  const void *context, void *hit);
bool wide_any(const struct wide *tree, ray *r, leaf_test_fn *test,
              const void *context, void *hit);

/* The same for a tree over a mesh's triangles, numbered as the mesh does, that
 * is put somewhere else. The ray, t and the hit's primitive are the
 * world's. */
bool wide_nearest_placed(const struct wide *tree, const struct placement *place,
                         ray *r, void *hit);
bool wide_any_placed(const struct wide *tree, const struct placement *place,
                     ray *r, void *hit);

#endif
