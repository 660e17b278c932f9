/* aabb.c - assignment 02: a loop over the axes that divides by the direction.
 *
 * Double precision. The quotient of two numbers that single precision holds
 * is rounded once, and rounding keeps the order: what comes first stays
 * first, so no box is lost. A zero component needs no division. */
#include "accel/aabb.h"

/* The t at which the ray crosses the plane where the axis has this value. */
static double crossing(double plane, double origin, double direction)
{
    return (plane - origin) / direction;
}

bool aabb_intersect(const aabb *box, const ray *r, float *t_enter,
                    float *t_exit)
{
    double enter = (double)r->t_min, leave = (double)r->t_max;
    for (int axis = 0; axis < 3; axis++) {
        double lower = (double)vec3_axis(box->lower, axis);
        double upper = (double)vec3_axis(box->upper, axis);
        double origin = (double)vec3_axis(r->origin, axis);
        double direction = (double)vec3_axis(r->direction, axis);
        if (direction == 0.0) {
            if (origin < lower || origin > upper)
                return false;
            continue;
        }
        double first =
            crossing(direction > 0.0 ? lower : upper, origin, direction);
        double second =
            crossing(direction > 0.0 ? upper : lower, origin, direction);
        if (first > enter)
            enter = first;
        if (second < leave)
            leave = second;
    }
    if (enter > leave)
        return false;
    *t_enter = (float)enter;
    *t_exit = (float)leave;
    return true;
}
