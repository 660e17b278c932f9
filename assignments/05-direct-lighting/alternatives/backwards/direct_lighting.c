/* direct_lighting.c - the light looks for the surface: what it meets first
 * must not be nearer than the vertex. */
#include "integrators/direct_lighting.h"

static float largest(vec3 v)
{
    return fmaxf(fabsf(v.x), fmaxf(fabsf(v.y), fabsf(v.z)));
}

/* Begins as far from the target as rounding may move the surface that holds
 * it, and ends as far from the vertex's own. */
static bool seen_by(const struct scene *scene, const struct surface *surface,
                    vec3 target)
{
    struct scene_hit hit;
    vec3 way = vec3_sub(surface->position, target);
    vec3 end = surface_ray(surface, vec3_negate(way), 1.0f).origin;
    float length = vec3_length(way);
    float size = fmaxf(length, fmaxf(largest(target), largest(end)));
    float slack = 8e-6f * size / length;
    ray r = ray_make(target, vec3_sub(end, target), slack, 1.0f - slack);
    return !scene_nearest(scene, &r, &hit);
}

rgb direct_light(const struct scene *scene, const struct vertex *v,
                 const struct light_sample *s)
{
    rgb f = material_eval(v->object->material, &v->surface, v->outgoing,
                          s->direction);
    float weight =
        fabsf(vec3_dot(s->direction, v->surface.shading_normal)) / s->pdf;
    rgb seen = rgb_scale(rgb_mul(f, s->radiance), weight);
    if (rgb_is_black(seen))
        return seen;
    bool free_way =
        s->infinite ? !scene_direction_blocked(scene, &v->surface, s->direction)
                    : seen_by(scene, &v->surface, s->target);
    return free_way ? seen : rgb_grey(0.0f);
}
