/* intersection_test.c - assignment 04: what is seen through clear surfaces.
 *
 * The contract is in intersection_test.h. */
#include "integrators/intersection_test.h"

#include "base/todo.h"
#include "integrators/bounce.h"
#include "integrators/delta_lighting.h"

//> intersection_test.radiance: Find what a ray sees
rgb intersection_test_radiance(const struct tracer *t, ray r,
                               struct ray_differential d)
{
#ifndef TODO_intersection_test
    rgb throughput = rgb_grey(1.0f);
    for (int passed = 0; passed <= t->scene->integrator.max_depth; passed++) {
        struct vertex v;
        struct scatter way;
        //> intersection_test.radiance.stop: Stop where the light is known
        if (!tracer_hit(t, &r, &d, &v) || v.object->material == NULL)
            break;
        if (!material_is_specular(v.object->material))
            return rgb_mul(throughput, delta_lighting(t, &v));
        //< intersection_test.radiance.stop
        //> intersection_test.radiance.go_on: Go on through a clear surface
        if (!bounce(t, &v, &r, &d, &way))
            break;
        throughput = rgb_mul(throughput, way.weight);
        //< intersection_test.radiance.go_on
    }
    return rgb_grey(0.0f);
#else
    /* TODO(intersection_test): follow the ray through clear surfaces to the
     * first that is not, and return the light there. intersection_test.h says
     * what must hold. Until then the first surface is the last. */
    struct vertex first;
    TODO_WARN("04 refraction", "clear objects are black");
    bool lit = tracer_hit(t, &r, &d, &first) && first.object->material;
    return lit ? delta_lighting(t, &first) : rgb_grey(0.0f);
#endif
}
//< intersection_test.radiance
