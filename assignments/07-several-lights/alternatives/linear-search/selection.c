/* selection.c - in single precision: the probabilities themselves, and a walk
 * along them. */
#include "lights/selection.h"

#include "base/memory.h"

struct light_choice {
    float probability;
};

static float weight_of(const struct light *light, bool by_power, float radius)
{
    return by_power ? light_power(light, radius) : 1.0f;
}

struct light_table light_table_make(const struct light lights[], uint32_t count,
                                    bool by_power, float scene_radius)
{
    struct light_table t = {count, mem_alloc(count, sizeof *t.choices)};
    float mean = 0.0f, total = 0.0f;
    for (uint32_t i = 0; i < count; i++) {
        float w = weight_of(&lights[i], by_power, scene_radius);
        mean += w / (float)count;
    }
    for (uint32_t i = 0; i < count; i++) {
        float w = weight_of(&lights[i], by_power, scene_radius);
        if (w > 0.0f && w < LIGHT_SMALLEST_SHARE * mean)
            w = LIGHT_SMALLEST_SHARE * mean;
        t.choices[i].probability = w;
        total += w;
    }
    for (uint32_t i = 0; i < count; i++)
        t.choices[i].probability = total > 0.0f
                                       ? t.choices[i].probability / total
                                       : 1.0f / (float)count;
    return t;
}

/* Rounding may leave a little beyond the last stretch: it belongs to the last
 * light that can be picked. */
uint32_t light_table_pick(const struct light_table *t, float random,
                          float *probability)
{
    uint32_t light = 0;
    float end = 0.0f;
    for (uint32_t i = 0; i < t->count; i++) {
        if (t->choices[i].probability == 0.0f)
            continue;
        light = i;
        end += t->choices[i].probability;
        if (random < end)
            break;
    }
    *probability = t->choices[light].probability;
    return light;
}

float light_table_probability(const struct light_table *t, uint32_t light)
{
    return t->choices[light].probability;
}

void light_table_free(struct light_table *t)
{
    mem_free(t->choices);
    t->choices = NULL;
    t->count = 0;
}
