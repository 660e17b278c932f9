/* intersection_test.c - first the way to the last surface, then its light. The
 * weights are multiplied in double precision. */
#include "integrators/intersection_test.h"

#include "integrators/bounce.h"
#include "integrators/delta_lighting.h"

struct journey {
    ray r;
    struct ray_differential d;
    struct vertex v;
    double weight[3];
    int passed;
};

static bool is_clear(const struct vertex *v)
{
    return v->object->material && material_is_specular(v->object->material);
}

static bool pass(const struct tracer *t, struct journey *j)
{
    struct scatter way;
    if (j->passed == t->scene->integrator.max_depth)
        return false;
    if (!bounce(t, &j->v, &j->r, &j->d, &way))
        return false;
    j->passed++;
    j->weight[0] *= (double)way.weight.r;
    j->weight[1] *= (double)way.weight.g;
    j->weight[2] *= (double)way.weight.b;
    return tracer_hit(t, &j->r, &j->d, &j->v);
}

rgb intersection_test_radiance(const struct tracer *t, ray r,
                               struct ray_differential d)
{
    struct journey j = {.r = r, .d = d, .weight = {1.0, 1.0, 1.0}};
    bool arrived = tracer_hit(t, &j.r, &j.d, &j.v);
    while (arrived && is_clear(&j.v))
        arrived = pass(t, &j);
    if (!arrived || j.v.object->material == NULL)
        return rgb_grey(0.0f);
    rgb light = delta_lighting(t, &j.v);
    return rgb_make((float)(j.weight[0] * (double)light.r),
                    (float)(j.weight[1] * (double)light.g),
                    (float)(j.weight[2] * (double)light.b));
}
