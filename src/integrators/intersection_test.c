/* intersection_test.c - see intersection_test.h. */
#include "integrators/intersection_test.h"

#include "integrators/direct_lighting.h"

rgb intersection_test_radiance(const struct scene *scene, const ray *r)
{
    struct scene_hit hit;
    const struct material *material;
    if (!scene_nearest(scene, r, &hit))
        return rgb_grey(0.0f);
    struct surface s = scene_surface(scene, r, &hit, &material);
    vec3 outgoing = vec3_negate(vec3_normalize(r->direction));
    rgb radiance = rgb_grey(0.0f);
    for (uint32_t i = 0; i < scene->light_count; i++)
        radiance =
            rgb_add(radiance, direct_point_light(scene, &s, material, outgoing,
                                                 &scene->lights[i]));
    return radiance;
}
