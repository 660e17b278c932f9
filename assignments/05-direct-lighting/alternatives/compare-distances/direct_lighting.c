/* direct_lighting.c - the nearest hit along an endless ray is compared with
 * the distance of the light. */
#include "integrators/direct_lighting.h"

static float largest(vec3 v)
{
    return fmaxf(fabsf(v.x), fmaxf(fabsf(v.y), fabsf(v.z)));
}

/* Rounding may move the lamp's own surface this much. */
static float bias(vec3 from, vec3 to, float distance)
{
    return 8e-6f * fmaxf(distance, fmaxf(largest(from), largest(to)));
}

static bool reaches(const struct scene *scene, const struct surface *surface,
                    const struct light_sample *s)
{
    struct scene_hit hit;
    if (s->infinite) {
        ray sun = surface_ray(surface, s->direction, INFINITY);
        return !scene_nearest(scene, &sun, &hit);
    }
    vec3 way = vec3_sub(s->target, surface->position);
    float distance = vec3_length(way);
    ray r = surface_ray(surface, vec3_scale(way, 1.0f / distance), INFINITY);
    if (!scene_nearest(scene, &r, &hit))
        return true;
    float left = vec3_length(vec3_sub(s->target, r.origin));
    return hit.t >= left - bias(surface->position, s->target, distance);
}

rgb direct_light(const struct scene *scene, const struct vertex *v,
                 const struct light_sample *s)
{
    const struct surface *surface = &v->surface;
    if (!reaches(scene, surface, s))
        return rgb_grey(0.0f);
    rgb light = rgb_scale(s->radiance, 1.0f / s->pdf);
    rgb irradiance = rgb_scale(
        light, fabsf(vec3_dot(surface->shading_normal, s->direction)));
    return rgb_mul(irradiance, material_eval(v->object->material, surface,
                                             v->outgoing, s->direction));
}
