/* accel.h - the acceleration structures behind one interface. */
#ifndef RAYBOOK_ACCEL_ACCEL_H
#define RAYBOOK_ACCEL_ACCEL_H

#include <stdbool.h>
#include <stdint.h>

#include "accel/bvh.h"
#include "accel/leaf.h"
#include "accel/wide.h"
#include "base/box.h"

/* ACCEL_WIDE is the fast one, ACCEL_BVH the one that the course is about.
 * ACCEL_LINEAR has no structure: it tests everything, which is what the
 * others are measured and checked against. ACCEL_EMBREE is another's
 * traversal of another's tree: accel/embree.h. */
enum accel_kind { ACCEL_WIDE, ACCEL_BVH, ACCEL_LINEAR, ACCEL_EMBREE };

/* NULL-terminated, in the order of enum accel_kind. */
extern const char *const accel_names[];

struct embree;

struct accel {
    enum accel_kind kind;
    uint32_t primitive_count;
    struct bvh_node *nodes; /* ACCEL_BVH */
    uint32_t node_count;    /* ACCEL_BVH, ACCEL_WIDE */
    struct wide wide;       /* ACCEL_WIDE */
    struct embree *embree;  /* ACCEL_EMBREE */
};

/* Is this kind in this build? All are but, perhaps, ACCEL_EMBREE. */
bool accel_available(enum accel_kind kind);

/* Builds a structure of an available kind over boxes[0 .. primitive_count - 1]
 * and fills order (room for primitive_count) with the order in which its
 * leaves name the primitives. Release with accel_free. */
struct accel accel_build(enum accel_kind kind, const aabb boxes[],
                         uint32_t primitive_count, uint32_t order[]);

/* Builds an ACCEL_WIDE that tests triangles itself, as wide_build does. Its
 * order is that of the source. Release with accel_free. */
struct accel accel_build_wide(const struct wide_source *source);

/* See bvh_nearest and bvh_any; for ACCEL_WIDE, wide_nearest and wide_any. */
bool accel_nearest(const struct accel *a, ray *r, leaf_test_fn *test,
                   const void *context, void *hit);
bool accel_any(const struct accel *a, ray *r, leaf_test_fn *test,
               const void *context, void *hit);

void accel_free(struct accel *a);

#endif
