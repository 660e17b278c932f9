/* direct_lighting.c - see direct_lighting.h. */
#include "integrators/direct_lighting.h"

float power_heuristic(float pdf, float other)
{
    /* By the ratio: the squares of a sun's density may overflow. */
    float ratio = other / pdf;
    return 1.0f / (1.0f + ratio * ratio);
}

static bool light_hidden(const struct tracer *t, const struct vertex *v,
                         const struct light_sample *s)
{
    if (s->infinite)
        return scene_direction_blocked(t->scene, &v->surface, s->direction);
    return scene_segment_blocked(t->scene, &v->surface, s->target);
}

rgb direct_light(const struct tracer *t, const struct vertex *v,
                 const struct light *light, float pick_probability, bool weigh)
{
    struct light_sample s;
    const struct material *material = v->object->material;
    vec2 random = sampler_2d(t->sampler);
    if (!light_sample(light, v->surface.position, random, &s))
        return rgb_grey(0.0f);
    rgb scattered =
        material_eval(material, &v->surface, v->outgoing, s.direction);
    /* Most hidden points face away from the light: ask the cheap one first. */
    bool hidden = !rgb_is_black(scattered) && light_hidden(t, v, &s);
    path_log_light(t->log, t->scene, light, &s, scattered, hidden);
    if (hidden || rgb_is_black(scattered))
        return rgb_grey(0.0f);
    float density = pick_probability * s.pdf, share = 1.0f;
    if (weigh && !s.delta)
        share =
            power_heuristic(density, material_pdf(material, &v->surface,
                                                  v->outgoing, s.direction));
    float cosine = fabsf(vec3_dot(s.direction, v->surface.shading_normal));
    return rgb_scale(rgb_mul(scattered, s.radiance), cosine * share / density);
}

static rgb ask_all(const struct tracer *t, const struct vertex *v, bool weigh)
{
    rgb sum = rgb_grey(0.0f);
    for (uint32_t i = 0; i < t->scene->light_count; i++)
        sum =
            rgb_add(sum, direct_light(t, v, &t->scene->lights[i], 1.0f, weigh));
    return sum;
}

rgb direct_lighting(const struct tracer *t, const struct vertex *v, bool weigh)
{
    const struct scene *scene = t->scene;
    if (scene->light_count == 0)
        return rgb_grey(0.0f);
    if (scene->integrator.selection == SELECT_ALL)
        return ask_all(t, v, weigh);
    float probability;
    uint32_t picked = light_table_pick(&scene->light_table,
                                       sampler_1d(t->sampler), &probability);
    return direct_light(t, v, &scene->lights[picked], probability, weigh);
}

float direct_lighting_pdf(const struct scene *scene, uint32_t light, vec3 point,
                          vec3 direction, vec3 position, vec3 normal)
{
    float pdf =
        light_pdf(&scene->lights[light], point, direction, position, normal);
    if (scene->integrator.selection == SELECT_ALL)
        return pdf;
    return pdf * light_table_probability(&scene->light_table, light);
}
