/* delta_lighting.c - see delta_lighting.h. */
#include "integrators/delta_lighting.h"

#include "integrators/ask_light.h"

rgb delta_lighting(const struct tracer *t, const struct vertex *v)
{
    const struct scene *scene = t->scene;
    const struct asking a = {t, v, false};
    rgb sum = rgb_grey(0.0f);
    for (uint32_t i = 0; i < scene->light_count; i++)
        if (light_is_delta(&scene->lights[i]))
            sum = rgb_add(sum, ask_light(&a, i));
    return sum;
}
