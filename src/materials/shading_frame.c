/* shading_frame.c - see shading_frame.h. */
#include "materials/shading_frame.h"

/* v less its part along the unit vector n. */
static vec3 across(vec3 v, vec3 n)
{
    return vec3_step(v, -vec3_dot(v, n), n);
}

struct shading_frame shading_frame_make(const struct surface *s)
{
    struct shading_frame f;
    vec3 along = across(s->dp_du, s->shading_normal);
    f.z = s->shading_normal;
    /* Of less than this share of dp_du, rounding errors are a large part. */
    if (!(vec3_length(along) > 1e-4f * vec3_length(s->dp_du))) {
        vec3_frame(f.z, &f.x, &f.y);
        return f;
    }
    /* Twice: the first time leaves errors the size of dp_du's. */
    f.x = vec3_normalize(across(vec3_normalize(along), f.z));
    f.y = vec3_cross(f.z, f.x);
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
