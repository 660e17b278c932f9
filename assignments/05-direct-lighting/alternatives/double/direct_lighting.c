/* direct_lighting.c - cosine and product in double precision, channel by
 * channel. */
#include "integrators/direct_lighting.h"

static double cosine_between(vec3 a, vec3 b)
{
    return (double)a.x * (double)b.x + (double)a.y * (double)b.y +
           (double)a.z * (double)b.z;
}

static float channel(float scattered, float radiance, double weight)
{
    return (float)((double)scattered * (double)radiance * weight);
}

rgb direct_light(const struct scene *scene, const struct vertex *v,
                 const struct light_sample *s)
{
    bool blocked =
        s->infinite ? scene_direction_blocked(scene, &v->surface, s->direction)
                    : scene_segment_blocked(scene, &v->surface, s->target);
    if (blocked)
        return rgb_grey(0.0f);
    rgb f = material_eval(v->object->material, &v->surface, v->outgoing,
                          s->direction);
    double cosine = cosine_between(s->direction, v->surface.shading_normal);
    double weight = fabs(cosine) / (double)s->pdf;
    return rgb_make(channel(f.r, s->radiance.r, weight),
                    channel(f.g, s->radiance.g, weight),
                    channel(f.b, s->radiance.b, weight));
}
