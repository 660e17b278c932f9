/* aabb.c - assignment 02: where a ray passes through a box.
 *
 * The contract is in aabb.h. */
#include "accel/aabb.h"

#include "base/todo.h"

//> aabb.slab: Clip a range of t to one slab
#ifndef TODO_aabb_intersect
/* Each t carries a relative error of at most 3 roundings of 2^-24. Moving the
 * far plane out by the worst case of both never loses a box that is crossed
 * (Ize 2013, section 3). */
static const float slack = 1.0f + 6.0f * 0x1p-24f;

/* The slab is the space between two parallel planes. Both comparisons are
 * false for NaN (origin on a plane, direction along it), so that such a plane
 * does not clip: the origin lies on the slab's edge, which counts as in. */
static inline void clip_to_slab(float lower, float upper, float origin,
                                float inverse, float *t_enter, float *t_exit)
{
    bool backwards = signbit(inverse);
    float t_near = ((backwards ? upper : lower) - origin) * inverse;
    float t_far = ((backwards ? lower : upper) - origin) * inverse * slack;
    *t_enter = t_near > *t_enter ? t_near : *t_enter;
    *t_exit = t_far < *t_exit ? t_far : *t_exit;
}
#endif
//< aabb.slab

//> aabb.intersect: Find where a ray passes through a box
bool aabb_intersect(const aabb *box, const ray *r, float *t_enter,
                    float *t_exit)
{
#ifndef TODO_aabb_intersect
    vec3 o = r->origin, inverse = r->inverse_direction;
    float enter = r->t_min, leave = r->t_max;
    clip_to_slab(box->lower.x, box->upper.x, o.x, inverse.x, &enter, &leave);
    clip_to_slab(box->lower.y, box->upper.y, o.y, inverse.y, &enter, &leave);
    clip_to_slab(box->lower.z, box->upper.z, o.z, inverse.z, &enter, &leave);
    if (!(enter <= leave))
        return false;
    *t_enter = enter;
    *t_exit = leave;
    return true;
#else
    /* TODO(aabb_intersect): clip [t_min, t_max] to the slab of each axis in
     * turn; if something is left, that is where the ray is in the box.
     * Until then every box is hit, which is slow but never wrong. */
    (void)box;
    TODO_WARN("02 aabb", "every box counts as hit");
    *t_enter = r->t_min;
    *t_exit = r->t_max;
    return true;
#endif
}
//< aabb.intersect
