/* twigs.h - the binary tree that a wide one is made of.
 *
 * Large ranges are split by several threads at once. */
#ifndef RAYBOOK_ACCEL_TWIGS_H
#define RAYBOOK_ACCEL_TWIGS_H

#include <stdint.h>

#include "accel/ranges.h"
#include "base/box.h"

enum { TWIGS_WIDE = 8 };

/* children = 0: a leaf of the references first .. first + count - 1, count at
 * most RANGE_LEAF. Otherwise the children are twigs[children] and the one
 * behind it, and count references lie below. twigs[0] is the root. */
struct twig {
    aabb box;
    uint32_t first, count;
    uint32_t children;
    uint32_t leaves; /* below, or 1 */
    uint32_t nodes;  /* for who makes something of the tree */
    float cost[TWIGS_WIDE];
    uint8_t left_share[TWIGS_WIDE];
};

/* Sorts the references and splits them into leaves. twigs has room for 2 count
 * of them; which is where depends on the threads' timing, but what the tree is
 * depends on the references alone. No leaf is deeper than depth_limit, the
 * root being at 1, however boxes lie; 40 is enough for 2^32 that have to be
 * halved. count must be positive. */
void twigs_grow(struct reference references[], uint32_t count, int depth_limit,
                struct twig twigs[]);

/* The children of the wide node that a twig (no leaf) is best made into: at
 * most TWIGS_WIDE twigs, so chosen that the surface area heuristic finds the
 * whole tree below cheapest. Returns how many there are. */
int twigs_open(const struct twig twigs[], uint32_t index,
               uint32_t child[TWIGS_WIDE]);

#endif
