/* intersection_test.c - see intersection_test.h. */
#include "integrators/intersection_test.h"

#include "integrators/bounce.h"
#include "integrators/direct_lighting.h"

static rgb lit_by_points(const struct tracer *t, const struct vertex *v)
{
    const struct scene *scene = t->scene;
    rgb sum = rgb_grey(0.0f);
    for (uint32_t i = 0; i < scene->light_count; i++)
        if (light_is_delta(&scene->lights[i]))
            sum = rgb_add(sum,
                          direct_light(t, v, &scene->lights[i], 1.0f, false));
    return sum;
}

rgb intersection_test_radiance(const struct tracer *t, ray r,
                               struct ray_differential d)
{
    struct vertex v;
    rgb throughput = rgb_grey(1.0f);
    for (int depth = 0; depth <= t->scene->integrator.max_depth; depth++) {
        struct scatter way;
        if (!tracer_hit(t, &r, &d, &v) || v.object->material == NULL)
            break;
        if (!material_is_specular(v.object->material))
            return rgb_mul(throughput, lit_by_points(t, &v));
        if (!bounce(t, &v, &r, &d, &way))
            break;
        counters_mine.specular_rays++;
        throughput = rgb_mul(throughput, way.weight);
    }
    return rgb_grey(0.0f);
}
