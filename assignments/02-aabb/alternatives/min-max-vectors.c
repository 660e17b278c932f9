/* aabb.c - assignment 02: all three slabs at once, with the minima and maxima
 * of vectors.
 *
 * Single precision. A plane that the ray lies in gives NaN (0 times infinity);
 * it is taken out before anything is compared. */
#include "accel/aabb.h"

#include <float.h>

static vec3 multiply(vec3 a, vec3 b)
{
    return vec3_make(a.x * b.x, a.y * b.y, a.z * b.z);
}

static float largest(vec3 a)
{
    return fmaxf(a.x, fmaxf(a.y, a.z));
}

static float least(vec3 a)
{
    return fminf(a.x, fminf(a.y, a.z));
}

/* Minima and maxima turn a box round that is inside out, so ask first. */
static bool is_empty(const aabb *box)
{
    return box->lower.x > box->upper.x || box->lower.y > box->upper.y ||
           box->lower.z > box->upper.z;
}

bool aabb_intersect(const aabb *box, const ray *r, float *t_enter,
                    float *t_exit)
{
    if (is_empty(box))
        return false;
    vec3 a = multiply(vec3_sub(box->lower, r->origin), r->inverse_direction);
    vec3 b = multiply(vec3_sub(box->upper, r->origin), r->inverse_direction);
    bool in_x = isnan(a.x) || isnan(b.x), in_y = isnan(a.y) || isnan(b.y);
    bool in_z = isnan(a.z) || isnan(b.z);
    vec3 near = vec3_min(a, b), far = vec3_max(a, b);
    near = vec3_make(in_x ? -INFINITY : near.x, in_y ? -INFINITY : near.y,
                     in_z ? -INFINITY : near.z);
    far = vec3_make(in_x ? INFINITY : far.x, in_y ? INFINITY : far.y,
                    in_z ? INFINITY : far.z);

    float enter = fmaxf(largest(near), r->t_min);
    float leave = fminf(least(far) * (1.0f + 4.0f * FLT_EPSILON), r->t_max);
    *t_enter = enter;
    *t_exit = leave;
    return enter <= leave;
}
