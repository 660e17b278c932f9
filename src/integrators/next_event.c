/* next_event.c - see next_event.h. */
#include "integrators/next_event.h"

#include "integrators/several_lights.h"

rgb next_event(const struct tracer *t, const struct vertex *v, bool weigh)
{
    const struct scene *scene = t->scene;
    const struct asking a = {t, v, weigh};
    if (scene->light_count == 0)
        return rgb_grey(0.0f);
    if (scene->integrator.selection == SELECT_ALL)
        return all_lights(&a, scene->light_count);
    return one_light(&a, &scene->light_table, sampler_1d(t->sampler));
}

float next_event_pdf(const struct scene *scene, uint32_t light, vec3 point,
                     vec3 direction, vec3 position, vec3 normal)
{
    return asking_probability(scene, light) *
           light_pdf(&scene->lights[light], point, direction, position, normal);
}
