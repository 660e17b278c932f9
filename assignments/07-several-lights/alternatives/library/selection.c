/* selection.c - with the table that the environment map uses as well. */
#include "lights/selection.h"

#include "base/memory.h"
#include "sampling/distribution.h"

struct light_choice {
    struct distribution_1d table;
};

static double mean_power(const struct light lights[], uint32_t count,
                         float radius)
{
    double sum = 0.0;
    for (uint32_t i = 0; i < count; i++)
        sum += (double)light_power(&lights[i], radius);
    return sum / count;
}

static float weight(float power, double mean)
{
    double least = (double)LIGHT_SMALLEST_SHARE * mean;
    return power > 0.0f && (double)power < least ? (float)least : power;
}

struct light_table light_table_make(const struct light lights[], uint32_t count,
                                    bool by_power, float scene_radius)
{
    struct light_table t = {count, mem_alloc(1, sizeof *t.choices)};
    float *weights = mem_alloc(count, sizeof *weights);
    double mean = by_power ? mean_power(lights, count, scene_radius) : 1.0;
    for (uint32_t i = 0; i < count; i++)
        weights[i] = by_power
                         ? weight(light_power(&lights[i], scene_radius), mean)
                         : 1.0f;
    t.choices->table = distribution_1d_make(weights, count);
    mem_free(weights);
    return t;
}

uint32_t light_table_pick(const struct light_table *t, float random,
                          float *probability)
{
    uint32_t light = distribution_1d_sample(&t->choices->table, random, NULL);
    *probability = light_table_probability(t, light);
    return light;
}

float light_table_probability(const struct light_table *t, uint32_t light)
{
    return distribution_1d_probability(&t->choices->table, light);
}

void light_table_free(struct light_table *t)
{
    if (t->choices != NULL)
        distribution_1d_free(&t->choices->table);
    mem_free(t->choices);
    t->choices = NULL;
    t->count = 0;
}
