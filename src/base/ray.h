/* ray.h - the part of a line between two parameters. */
#ifndef RAYBOOK_BASE_RAY_H
#define RAYBOOK_BASE_RAY_H

#include "base/vec.h"

/* The points origin + t direction with t_min <= t <= t_max, 0 <= t_min.
 *
 * direction need not have length one; t counts in units of its length.
 * inverse_direction is 1 / direction, component by component: a component of
 * direction that is +0 or -0 gives +infinity or -infinity there, never a
 * clamped value. Use ray_make, which keeps the two in step. */
typedef struct {
    vec3 origin;
    float t_min;
    vec3 direction;
    float t_max;
    vec3 inverse_direction;
} ray;

static inline ray ray_make(vec3 origin, vec3 direction, float t_min,
                           float t_max)
{
    ray r = {origin, t_min, direction, t_max, {0.0f, 0.0f, 0.0f}};
    r.inverse_direction =
        vec3_make(1.0f / direction.x, 1.0f / direction.y, 1.0f / direction.z);
    return r;
}

static inline vec3 ray_at(const ray *r, float t)
{
    return vec3_step(r->origin, t, r->direction);
}

#endif
