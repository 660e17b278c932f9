/* surface.c - see surface.h. */
#include "shapes/surface.h"

#include <float.h>
#include <stdint.h>
#include <string.h>

#include "base/constants.h"
#include "base/minmax.h"

/* The ends of an open range of t, as floats. */
static const float just_above_0 = FLT_MIN, just_below_1 = 1.0f - 0x1p-24f;

//> surface.footprint: Measure the footprint of a pixel
/* How the point where a ray meets the plane through it moves when the ray
 * changes: the change of the ray there, slid along the ray back into the
 * plane. t is the distance in units of the direction. */
static vec3 slide(const struct surface *s, const ray *r, float t,
                  vec3 origin_change, vec3 direction_change)
{
    vec3 n = s->geometric_normal;
    vec3 change = vec3_step(origin_change, t, direction_change);
    float along = vec3_dot(change, n) / vec3_dot(r->direction, n);
    vec3 step = vec3_step(change, -along, r->direction);
    return vec3_is_finite(step) ? step : vec3_make(0.0f, 0.0f, 0.0f);
}

void surface_step(const struct surface *s, const ray *r,
                  const struct ray_differential *d, vec3 *dp_dx, vec3 *dp_dy)
{
    vec3 way = vec3_sub(s->position, r->origin);
    float t =
        vec3_dot(way, r->direction) / vec3_dot(r->direction, r->direction);
    *dp_dx = slide(s, r, t, d->origin_dx, d->direction_dx);
    *dp_dy = slide(s, r, t, d->origin_dy, d->direction_dy);
}

/* The combination of dp_du and dp_dv nearest to step: the normal equations. */
static vec2 in_texture(const struct surface *s, vec3 step)
{
    float uu = vec3_dot(s->dp_du, s->dp_du), uv = vec3_dot(s->dp_du, s->dp_dv);
    float vv = vec3_dot(s->dp_dv, s->dp_dv);
    float u = vec3_dot(s->dp_du, step), v = vec3_dot(s->dp_dv, step);
    float k = 1.0f / (uu * vv - uv * uv);
    vec2 d = vec2_make(k * (vv * u - uv * v), k * (uu * v - uv * u));
    return isfinite(d.x) && isfinite(d.y) ? d : vec2_make(0.0f, 0.0f);
}

void surface_footprint(struct surface *s, const ray *r,
                       const struct ray_differential *d)
{
    vec3 dp_dx, dp_dy;
    s->uv_dx = s->uv_dy = vec2_make(0.0f, 0.0f);
    if (ray_differential_is_zero(d))
        return; /* as after each rough bounce */
    surface_step(s, r, d, &dp_dx, &dp_dy);
    s->uv_dx = in_texture(s, dp_dx);
    s->uv_dy = in_texture(s, dp_dy);
}
//< surface.footprint

//> surface.leave: Start a ray off the surface
/* The next float above x (steps 1) or below it (steps -1), or x (0). Floats of
 * one sign are in the order of their bits. */
static float next_float(float x, int steps)
{
    uint32_t bits;
    if (x == 0.0f || !isfinite(x))
        return steps == 0 ? x : nextafterf(x, (float)steps * INFINITY);
    memcpy(&bits, &x, sizeof bits);
    bits += (uint32_t)(x > 0.0f ? steps : -steps);
    memcpy(&x, &bits, sizeof bits);
    return x;
}

/* The next number away from where the point came from: adding a small offset
 * to a large coordinate may round it away altogether. */
static float round_outwards(float moved, float offset)
{
    return next_float(moved, (offset > 0.0f) - (offset < 0.0f));
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
//< surface.leave

//> surface.segment: End a ray before its target
/* How far before the point the way ends, in units of the way: the bound on the
 * error of t where the way meets a surface that holds the point (a lamp that
 * lies on a wall must not be hidden by that wall). Each coordinate passes
 * through at most 16 roundings on its way into t. */
static float slack_at_end(vec3 start, vec3 point)
{
    vec3 size = vec3_add(vec3_abs(start), vec3_abs(point));
    float length = vec3_length(vec3_sub(point, start));
    float slack = rounding_bound(16) * (size.x + size.y + size.z) / length;
    return slack < 0.5f ? slack : 0.5f;
}

ray surface_segment(const struct surface *s, vec3 point)
{
    vec3 start = leave(s, vec3_sub(point, s->position));
    float end = float_min(just_below_1, 1.0f - slack_at_end(start, point));
    return ray_make(start, vec3_sub(point, start), just_above_0, end);
}
//< surface.segment
