/* selection.c - see selection.h. */
#include "lights/selection.h"

#include "base/memory.h"

/* Power is only an estimate: a faint light may be the only one that reaches a
 * corner, and what is picked with a chance of p counts 1 / p times. No light
 * gets less than this part of an even share. */
static const float smallest_share = 1e-3f;

static float sum(const float values[], uint32_t count)
{
    double total = 0.0;
    for (uint32_t i = 0; i < count; i++)
        total += (double)values[i];
    return (float)total;
}

/* Raises weights that are above 0, but small, to a part of the mean. */
static void raise_small(float weights[], uint32_t count)
{
    float least = smallest_share * (sum(weights, count) / (float)count);
    for (uint32_t i = 0; i < count; i++)
        if (weights[i] > 0.0f)
            weights[i] = fmaxf(weights[i], least);
}

struct light_table light_table_make(const struct light lights[], uint32_t count,
                                    bool by_power, float scene_radius)
{
    struct light_table t = {count, {0}};
    float *weights = mem_alloc(count, sizeof *weights);
    for (uint32_t i = 0; i < count; i++)
        weights[i] = by_power ? light_power(&lights[i], scene_radius) : 1.0f;
    raise_small(weights, count);
    t.picks = distribution_1d_make(weights, count);
    mem_free(weights);
    return t;
}

uint32_t light_table_pick(const struct light_table *t, float random,
                          float *probability)
{
    uint32_t light = distribution_1d_sample(&t->picks, random, NULL);
    *probability = light_table_probability(t, light);
    return light;
}

float light_table_probability(const struct light_table *t, uint32_t light)
{
    return distribution_1d_probability(&t->picks, light);
}

void light_table_free(struct light_table *t)
{
    distribution_1d_free(&t->picks);
    t->count = 0;
}
