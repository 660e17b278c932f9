/* ranges.h - boxes on their way into a tree, and how they are split in two.
 *
 * Made for speed: boxes are moved instead of their numbers, so that memory is
 * read in order. */
#ifndef RAYBOOK_ACCEL_RANGES_H
#define RAYBOOK_ACCEL_RANGES_H

#include <stdbool.h>
#include <stdint.h>

#include "base/box.h"

/* A leaf has room for so many. */
enum { RANGE_LEAF = 8 };

/* A box in eight floats: the lower corner, one float to spare, the upper
 * corner negated, and one more. So one minimum of eight joins two boxes. */
struct bounds {
    float side[8];
};

/* A primitive on its way through the builder; its number is stored, bit by
 * bit, in the first float to spare. In the second there is -1 if it must be
 * alone in its leaf, else 0: the minimum says whether any of several must. */
struct reference {
    struct bounds bounds;
};

/* Coordinates beyond 1e30 are cut to that: no beam (beam.h) goes so far. */
struct reference reference_make(const aabb *box, uint32_t primitive,
                                bool alone);
uint32_t reference_primitive(const struct reference *r);

/* A range of references with the bounds of its boxes and of their centroids
 * (twice). */
struct range {
    uint32_t first, count;
    struct bounds boxes, centroids;
};

/* The bounds as a box. */
aabb bounds_box(const struct bounds *b);

/* All references. Several threads share the work. */
struct range range_of_all(const struct reference references[], uint32_t count);

/* May the range be a leaf? It has at most RANGE_LEAF references, or one if any
 * of them must be alone. */
bool range_is_leaf(const struct range *range);

/* Splits a range that is no leaf where the surface area heuristic
 * finds it cheapest, and sorts its references accordingly; by halves, as they
 * stand, where it finds no place (all centroids are one) or where more than
 * levels levels would be needed below otherwise.
 *
 * Source: I. Wald, "On fast Construction of SAH-based Bounding Volume
 * Hierarchies", IEEE Symposium on Interactive Ray Tracing, 2007. */
void range_split(struct reference references[], const struct range *range,
                 int levels, struct range *left, struct range *right);

#endif
