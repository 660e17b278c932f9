/* aabb.c - assignment 02: a loop over the axes in single precision, the two
 * crossings exchanged where they come in the wrong order.
 *
 * A direction of zero is looked at first, so that nothing is infinite; and the
 * box is made a little thicker instead of the exit later. */
#include "accel/aabb.h"

#include <float.h>

static void swap(float *a, float *b)
{
    float t = *a;
    *a = *b;
    *b = t;
}

bool aabb_intersect(const aabb *box, const ray *r, float *t_enter,
                    float *t_exit)
{
    *t_enter = r->t_min;
    *t_exit = r->t_max;
    for (int axis = 0; axis < 3; axis++) {
        float o = vec3_axis(r->origin, axis);
        float d = vec3_axis(r->direction, axis);
        float to_lower = vec3_axis(box->lower, axis) - o;
        float to_upper = vec3_axis(box->upper, axis) - o;
        if (to_lower > to_upper)
            return false;
        if (d == 0.0f && (to_lower > 0.0f || to_upper < 0.0f))
            return false;
        if (d == 0.0f)
            continue;
        float near = to_lower / d, far = to_upper / d;
        if (near > far)
            swap(&near, &far);
        near -= 2.0f * FLT_EPSILON * fabsf(near);
        far += 2.0f * FLT_EPSILON * fabsf(far);
        if (near > *t_enter)
            *t_enter = near;
        if (far < *t_exit)
            *t_exit = far;
    }
    return *t_enter <= *t_exit;
}
