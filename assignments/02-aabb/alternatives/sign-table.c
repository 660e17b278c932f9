/* aabb.c - assignment 02: a table of the two corners, and the direction's
 * signs as places in it; each axis written out, with an exit after each.
 *
 * Single precision, with the inverse direction. The exit is moved out by a
 * few last digits, which is more than rounding can do.
 *
 * Source: A. Williams et al., "An Efficient and Robust Ray-Box Intersection
 * Algorithm", Journal of Graphics Tools 10(1), 2005. */
#include "accel/aabb.h"

#include <float.h>

static const float wider = 1.0f + 4.0f * FLT_EPSILON;

bool aabb_intersect(const aabb *box, const ray *r, float *t_enter,
                    float *t_exit)
{
    const vec3 corner[2] = {box->lower, box->upper};
    const vec3 inverse = r->inverse_direction;
    /* -0 is below zero here: its inverse is minus infinity. */
    const int x = inverse.x < 0.0f, y = inverse.y < 0.0f, z = inverse.z < 0.0f;
    float enter = r->t_min, leave = r->t_max, t;

    t = (corner[x].x - r->origin.x) * inverse.x;
    if (t > enter)
        enter = t;
    t = (corner[1 - x].x - r->origin.x) * inverse.x * wider;
    if (t < leave)
        leave = t;
    if (enter > leave)
        return false;

    t = (corner[y].y - r->origin.y) * inverse.y;
    if (t > enter)
        enter = t;
    t = (corner[1 - y].y - r->origin.y) * inverse.y * wider;
    if (t < leave)
        leave = t;
    if (enter > leave)
        return false;

    t = (corner[z].z - r->origin.z) * inverse.z;
    if (t > enter)
        enter = t;
    t = (corner[1 - z].z - r->origin.z) * inverse.z * wider;
    if (t < leave)
        leave = t;
    if (enter > leave)
        return false;

    *t_enter = enter;
    *t_exit = leave;
    return true;
}
