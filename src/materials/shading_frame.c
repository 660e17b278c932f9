/* shading_frame.c - see shading_frame.h. */
#include "materials/shading_frame.h"

struct shading_frame shading_frame_make(const struct surface *s)
{
    struct shading_frame f;
    f.z = s->shading_normal;
    vec3 along = vec3_step(s->dp_du, -vec3_dot(s->dp_du, f.z), f.z);
    vec3 x = vec3_normalize(along);
    if (vec3_is_finite(x)) {
        /* Once more: little of dp_du may have been left, and its rounding
         * errors with it. */
        x = vec3_normalize(vec3_step(x, -vec3_dot(x, f.z), f.z));
        f.x = x;
        f.y = vec3_cross(f.z, x);
    } else {
        vec3_frame(f.z, &f.x, &f.y);
    }
    return f;
}

vec3 shading_frame_to_local(const struct shading_frame *f, vec3 world)
{
    return vec3_make(vec3_dot(world, f->x), vec3_dot(world, f->y),
                     vec3_dot(world, f->z));
}

vec3 shading_frame_to_world(const struct shading_frame *f, vec3 local)
{
    vec3 sum = vec3_scale(f->x, local.x);
    return vec3_step(vec3_step(sum, local.y, f->y), local.z, f->z);
}
