/* direct_lighting.c - visibility as a factor of 0 or 1, asked before the
 * material; nothing leaves early. */
#include "integrators/direct_lighting.h"

static float visibility(const struct scene *scene, const struct vertex *v,
                        const struct light_sample *s)
{
    if (s->infinite)
        return scene_direction_blocked(scene, &v->surface, s->direction) ? 0.0f
                                                                         : 1.0f;
    return scene_segment_blocked(scene, &v->surface, s->target) ? 0.0f : 1.0f;
}

rgb direct_light(const struct scene *scene, const struct vertex *v,
                 const struct light_sample *s)
{
    vec3 n = v->surface.shading_normal, l = s->direction;
    float geometry = fabsf(n.x * l.x + n.y * l.y + n.z * l.z);
    float factor = visibility(scene, v, s) * geometry / s->pdf;
    rgb f = material_eval(v->object->material, &v->surface, v->outgoing, l);
    rgb result = {f.r * s->radiance.r * factor, f.g * s->radiance.g * factor,
                  f.b * s->radiance.b * factor};
    return result;
}
