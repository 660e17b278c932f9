/* selection.c - cumulative weights that are never divided: the random number
 * is multiplied instead; searched from the last light down. */
#include "lights/selection.h"

#include "base/memory.h"

struct light_choice {
    double weight;
    double before; /* sum of the weights of the lights before this one */
};

static void weigh(struct light_choice c[], const struct light lights[],
                  uint32_t count, float radius)
{
    double sum = 0.0;
    for (uint32_t i = 0; i < count; i++)
        sum += c[i].weight = (double)light_power(&lights[i], radius);
    double least = sum * 0.001 / count;
    for (uint32_t i = 0; i < count; i++)
        if (c[i].weight != 0.0)
            c[i].weight = fmax(c[i].weight, least);
    if (sum == 0.0)
        for (uint32_t i = 0; i < count; i++)
            c[i].weight = 1.0;
}

/* One more choice than there are lights: its `before` is the sum of all. */
struct light_table light_table_make(const struct light lights[], uint32_t count,
                                    bool by_power, float scene_radius)
{
    struct light_table t;
    t.count = count;
    t.choices = mem_alloc((size_t)count + 1, sizeof *t.choices);
    for (uint32_t i = 0; i < count; i++)
        t.choices[i].weight = 1.0;
    if (by_power)
        weigh(t.choices, lights, count, scene_radius);
    for (uint32_t i = 0; i < count; i++)
        t.choices[i + 1].before = t.choices[i].before + t.choices[i].weight;
    return t;
}

uint32_t light_table_pick(const struct light_table *t, float random,
                          float *probability)
{
    double at = (double)random * t->choices[t->count].before;
    uint32_t light = t->count - 1;
    while (t->choices[light].weight == 0.0 || at < t->choices[light].before)
        light--;
    *probability = light_table_probability(t, light);
    return light;
}

float light_table_probability(const struct light_table *t, uint32_t light)
{
    return (float)(t->choices[light].weight / t->choices[t->count].before);
}

void light_table_free(struct light_table *t)
{
    mem_free(t->choices);
    t->choices = NULL;
    t->count = 0;
}
