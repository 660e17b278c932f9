/* direct_lighting.c - one ray for all lights: its direction is the whole way
 * to the light, so that t = 1 is the light and t_max is a little less. */
#include "integrators/direct_lighting.h"

static float taxicab(vec3 v)
{
    return fabsf(v.x) + fabsf(v.y) + fabsf(v.z);
}

static ray way_to(const struct surface *surface, const struct light_sample *s)
{
    if (s->infinite)
        return surface_ray(surface, s->direction, INFINITY);
    ray r = surface_ray(surface, vec3_sub(s->target, surface->position), 1.0f);
    vec3 way = vec3_sub(s->target, r.origin);
    float size = taxicab(s->target) + taxicab(r.origin);
    float slack = 1.2e-6f * size / vec3_length(way);
    return ray_make(r.origin, way, r.t_min, 1.0f - fminf(slack, 0.5f));
}

rgb direct_light(const struct scene *scene, const struct vertex *v,
                 const struct light_sample *s)
{
    struct scene_hit hit;
    const struct surface *surface = &v->surface;
    float cosine = vec3_dot(surface->shading_normal, s->direction);
    if (cosine == 0.0f)
        return rgb_grey(0.0f);
    ray r = way_to(surface, s);
    if (scene_nearest(scene, &r, &hit))
        return rgb_grey(0.0f);
    rgb f =
        material_eval(v->object->material, surface, v->outgoing, s->direction);
    f = rgb_scale(f, cosine < 0.0f ? -cosine : cosine);
    f = rgb_mul(f, s->radiance);
    return rgb_scale(f, 1.0f / s->pdf);
}
