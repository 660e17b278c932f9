/* intersection_test.c - by recursion: a clear surface shows what the ray that
 * goes on from it finds, times its weight. */
#include "integrators/intersection_test.h"

#include "integrators/bounce.h"
#include "integrators/delta_lighting.h"

static rgb seen(const struct tracer *t, ray r, struct ray_differential d,
                int clear_left)
{
    struct vertex v;
    if (!tracer_hit(t, &r, &d, &v))
        return rgb_grey(0.0f);
    const struct material *material = v.object->material;
    if (material == NULL)
        return rgb_grey(0.0f);
    if (!material_is_specular(material))
        return delta_lighting(t, &v);
    if (clear_left == 0)
        return rgb_grey(0.0f);
    struct scatter way;
    if (!bounce(t, &v, &r, &d, &way))
        return rgb_grey(0.0f);
    return rgb_mul(way.weight, seen(t, r, d, clear_left - 1));
}

rgb intersection_test_radiance(const struct tracer *t, ray r,
                               struct ray_differential d)
{
    return seen(t, r, d, t->scene->integrator.max_depth);
}
