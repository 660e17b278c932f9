/* aabb.c - assignment 02: the box as a centre and half its sides.
 *
 * The ray is in a slab for half the slab's thickness over |direction| before
 * and after it passes the middle plane. Double precision. */
#include "accel/aabb.h"

/* The box is left a relative 1e-9 too late, as against the 1e-16 that rounding
 * takes: a ray through an edge is in. */
static const double late = 1.0 + 1e-9;

static bool clip(float lower, float upper, float origin, float direction,
                 double *enter, double *leave)
{
    double to_lower = (double)lower - (double)origin;
    double to_upper = (double)upper - (double)origin;
    double speed = fabs((double)direction);
    if (!(to_lower <= to_upper))
        return false;
    if (speed == 0.0)
        return to_lower <= 0.0 && to_upper >= 0.0;
    double middle = 0.5 * (to_lower + to_upper);
    double half = 0.5 * (to_upper - to_lower);
    if (direction < 0.0f)
        middle = -middle;
    *enter = fmax(*enter, (middle - half) / speed);
    *leave = fmin(*leave, (middle + half) / speed * late);
    return true;
}

bool aabb_intersect(const aabb *box, const ray *r, float *t_enter,
                    float *t_exit)
{
    vec3 a = box->lower, b = box->upper, o = r->origin, d = r->direction;
    double enter = r->t_min, leave = r->t_max;
    bool crossed = clip(a.x, b.x, o.x, d.x, &enter, &leave);
    crossed = crossed && clip(a.y, b.y, o.y, d.y, &enter, &leave);
    crossed = crossed && clip(a.z, b.z, o.z, d.z, &enter, &leave);
    if (!crossed || enter > leave)
        return false;
    *t_enter = (float)enter;
    *t_exit = (float)leave;
    return true;
}
