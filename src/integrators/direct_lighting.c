/* direct_lighting.c - see direct_lighting.h. */
#include "integrators/direct_lighting.h"

rgb direct_point_light(const struct scene *scene, const struct surface *s,
                       const struct material *material, vec3 outgoing,
                       const struct point_light *light)
{
    vec3 to_light;
    rgb irradiance = point_light_irradiance(light, s->position, &to_light);
    rgb scattered = material_eval(material, s, outgoing, to_light);
    /* Most blocked points face away from the light: ask the cheap one first. */
    if (rgb_is_black(scattered) ||
        scene_segment_blocked(scene, s, light->position))
        return rgb_grey(0.0f);
    float cosine = fabsf(vec3_dot(to_light, s->shading_normal));
    return rgb_scale(rgb_mul(scattered, irradiance), cosine);
}
