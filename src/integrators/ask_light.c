/* ask_light.c - see ask_light.h. */
#include "integrators/ask_light.h"

#include "integrators/direct_lighting.h"
#include "integrators/mis.h"

float asking_probability(const struct scene *scene, uint32_t light)
{
    if (scene->integrator.selection == SELECT_ALL)
        return 1.0f;
    return light_table_probability(&scene->light_table, light);
}

static float share_of_asking(const struct asking *a, uint32_t light,
                             const struct light_sample *s)
{
    const struct vertex *v = a->v;
    if (!a->weigh || s->delta)
        return 1.0f;
    float asked = asking_probability(a->t->scene, light) * s->pdf;
    float scattered = material_pdf(v->object->material, &v->surface,
                                   v->outgoing, s->direction);
    return power_heuristic(asked, scattered);
}

static void tell(const struct asking *a, const struct light *light,
                 const struct light_sample *s, rgb found)
{
    const struct vertex *v = a->v;
    if (a->t->log == NULL)
        return;
    rgb bsdf = material_eval(v->object->material, &v->surface, v->outgoing,
                             s->direction);
    path_log_light(a->t->log, a->t->scene, light, s, bsdf, found);
}

rgb ask_light(const struct asking *a, uint32_t light)
{
    const struct scene *scene = a->t->scene;
    struct light_sample s;
    vec2 random = sampler_2d(a->t->sampler);
    if (!light_sample(&scene->lights[light], a->v->surface.position, random,
                      &s))
        return rgb_grey(0.0f);
    rgb found = direct_light(scene, a->v, &s);
    tell(a, &scene->lights[light], &s, found);
    if (rgb_is_black(found))
        return found;
    return rgb_scale(found, share_of_asking(a, light, &s));
}
