/* surface.c - see surface.h. */
#include "shapes/surface.h"

#include <float.h>

/* The ends of an open range of t, as floats. */
static const float just_above_0 = FLT_MIN, just_below_1 = 1.0f - 0x1p-24f;

/* The next number away from where the point came from: adding a small offset
 * to a large coordinate may round it away altogether. */
static float round_outwards(float moved, float offset)
{
    if (offset > 0.0f)
        return nextafterf(moved, INFINITY);
    if (offset < 0.0f)
        return nextafterf(moved, -INFINITY);
    return moved;
}

static vec3 leave(const struct surface *s, vec3 direction)
{
    vec3 n = s->geometric_normal;
    float distance = vec3_dot(vec3_abs(n), s->position_error);
    bool same_side = vec3_dot(direction, n) >= 0.0f;
    vec3 offset = vec3_scale(n, same_side ? distance : -distance);
    vec3 moved = vec3_add(s->position, offset);
    return vec3_make(round_outwards(moved.x, offset.x),
                     round_outwards(moved.y, offset.y),
                     round_outwards(moved.z, offset.z));
}

ray surface_ray(const struct surface *s, vec3 direction, float t_max)
{
    return ray_make(leave(s, direction), direction, just_above_0, t_max);
}

ray surface_segment(const struct surface *s, vec3 point)
{
    vec3 start = leave(s, vec3_sub(point, s->position));
    return ray_make(start, vec3_sub(point, start), just_above_0, just_below_1);
}
