/* nearest.h - which of two hits counts: one rule for every structure. */
#ifndef RAYBOOK_ACCEL_NEAREST_H
#define RAYBOOK_ACCEL_NEAREST_H

#include <stdbool.h>
#include <stdint.h>

#include "base/ray.h"

#define NO_PRIMITIVE UINT32_MAX

/* The nearest hit so far. Primitives are numbered as the scene file names
 * them. While there is none (NO_PRIMITIVE), t is where the range ends. */
struct nearest {
    uint32_t primitive;
    float t;
    float b1, b2; /* barycentric coordinates, of a triangle */
};

/* Boxes and primitives round differently. A structure that is told to look a
 * little further than the nearest hit does not pass over a box in which a hit
 * of the same t lies. */
static inline float a_little_beyond(float t)
{
    return t * (1.0f + 0x1p-20f);
}

/* Where several primitives meet, the first of the file is the one that is
 * hit: the answer must not depend on the order in which a structure asks. */
static inline bool comes_first(const struct nearest *a, const struct nearest *b)
{
    if (a->t != b->t || b->primitive == NO_PRIMITIVE)
        return a->t <= b->t;
    return a->primitive < b->primitive;
}

/* Takes hit as the best if it is, and ends the ray a little behind it. */
static inline bool nearest_offer(struct nearest *best,
                                 const struct nearest *hit, ray *r)
{
    if (!comes_first(hit, best))
        return false;
    *best = *hit;
    r->t_max = a_little_beyond(hit->t);
    return true;
}

#endif
