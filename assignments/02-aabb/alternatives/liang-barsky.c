/* aabb.c - assignment 02: a line clipped at six half-spaces, one after the
 * other.
 *
 * A half-space is q >= p t; p below zero means that the ray comes in. Nothing
 * is sorted and no sign is looked up. Double precision.
 *
 * Source: Y.-D. Liang and B. Barsky, "A New Concept and Method for Line
 * Clipping", ACM Transactions on Graphics 3(1), 1984. */
#include "accel/aabb.h"

struct range {
    double enter, leave;
};

/* What is left of the range on the side where p t <= q; false if nothing. */
static bool clip(double p, double q, struct range *range)
{
    if (p == 0.0)
        return q >= 0.0;
    double t = q / p;
    if (p < 0.0)
        range->enter = t > range->enter ? t : range->enter;
    else
        range->leave = t < range->leave ? t : range->leave;
    return range->enter <= range->leave;
}

static bool clip_axis(float lower, float upper, float origin, float direction,
                      struct range *range)
{
    double d = direction, o = origin;
    return clip(-d, o - (double)lower, range) &&
           clip(d, (double)upper - o, range);
}

bool aabb_intersect(const aabb *box, const ray *r, float *t_enter,
                    float *t_exit)
{
    vec3 a = box->lower, b = box->upper, o = r->origin, d = r->direction;
    struct range range = {r->t_min, r->t_max};
    if (!clip_axis(a.x, b.x, o.x, d.x, &range) ||
        !clip_axis(a.y, b.y, o.y, d.y, &range) ||
        !clip_axis(a.z, b.z, o.z, d.z, &range))
        return false;
    *t_enter = (float)range.enter;
    *t_exit = (float)range.leave;
    return true;
}
