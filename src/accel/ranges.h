/* ranges.h - boxes on their way into a tree, and how they are split in two.
 *
 * Made for speed: boxes are moved instead of their numbers, so that memory is
 * read in order. */
#ifndef RAYBOOK_ACCEL_RANGES_H
#define RAYBOOK_ACCEL_RANGES_H

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
 * bit, in the float to spare. */
struct reference {
    struct bounds bounds;
};

/* Coordinates beyond 1e30 are cut to that: no beam (beam.h) goes so far. */
struct reference reference_make(const aabb *box, uint32_t primitive);
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

/* Splits a range of more than RANGE_LEAF where the surface area heuristic
 * finds it cheapest, and sorts its references accordingly; by halves, as they
 * stand, where it finds no place (all centroids are one) or where more than
 * levels levels would be needed below otherwise.
 *
 * Source: I. Wald, "On fast Construction of SAH-based Bounding Volume
 * Hierarchies", IEEE Symposium on Interactive Ray Tracing, 2007. */
void range_split(struct reference references[], const struct range *range,
                 int levels, struct range *left, struct range *right);

#endif
