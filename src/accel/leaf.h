/* leaf.h - how an acceleration structure asks about primitives. */
#ifndef RAYBOOK_ACCEL_LEAF_H
#define RAYBOOK_ACCEL_LEAF_H

#include <stdbool.h>
#include <stdint.h>

#include "base/ray.h"

/* Tests the primitives order[first] .. order[first + count - 1] against the
 * ray. A hit within [t_min, t_max] is stored in *hit, r->t_max is lowered to
 * it or to a little beyond it, and the answer is true; otherwise nothing
 * changes. context is the caller's own. */
typedef bool leaf_test_fn(const void *context, uint32_t first, uint32_t count,
                          ray *r, void *hit);

#endif
