/* selection.c - assignment 07: one light out of many.
 *
 * The contract is in selection.h. */
#include "lights/selection.h"

#include "base/memory.h"
#include "base/todo.h"

//> selection: Pick one light out of many
#ifndef TODO_light_selection
/* Each light has a stretch of the line from 0 to 1, as long as it is likely;
 * they lie side by side, in the order of the lights. In double: after a bright
 * light the small steps of the faint ones would be lost in float. */
struct light_choice {
    double end; /* where the stretch ends; the next one begins there */
};

//> selection.weights: Weigh each light by its power
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
    float least = LIGHT_SMALLEST_SHARE * (sum(weights, count) / (float)count);
    for (uint32_t i = 0; i < count; i++)
        if (weights[i] > 0.0f)
            weights[i] = fmaxf(weights[i], least);
}
//< selection.weights

//> selection.make: Lay the lights side by side
static void lay_out(struct light_choice choices[], const float weights[],
                    uint32_t count)
{
    double total = 0.0;
    for (uint32_t i = 0; i < count; i++)
        choices[i].end = total += (double)weights[i];
    for (uint32_t i = 0; i < count; i++)
        choices[i].end =
            total > 0.0 ? choices[i].end / total : (i + 1.0) / count;
}

struct light_table light_table_make(const struct light lights[], uint32_t count,
                                    bool by_power, float scene_radius)
{
    struct light_table t = {count, NULL};
    float *weights = mem_alloc(count, sizeof *weights);
    for (uint32_t i = 0; i < count; i++)
        weights[i] = by_power ? light_power(&lights[i], scene_radius) : 1.0f;
    raise_small(weights, count);
    t.choices = mem_alloc(count, sizeof *t.choices);
    lay_out(t.choices, weights, count);
    mem_free(weights);
    return t;
}
//< selection.make

//> selection.pick: Find the stretch that holds a number
/* The first light whose stretch ends beyond the number. One of length 0 ends
 * where it begins, so it is never the first; the last ends at 1, beyond any
 * number. */
static uint32_t holder(const struct light_table *t, double number)
{
    uint32_t first = 0, last = t->count - 1;
    while (first < last) {
        uint32_t middle = first + (last - first) / 2;
        if (t->choices[middle].end > number)
            last = middle;
        else
            first = middle + 1;
    }
    return first;
}

uint32_t light_table_pick(const struct light_table *t, float random,
                          float *probability)
{
    uint32_t light = holder(t, (double)random);
    *probability = light_table_probability(t, light);
    return light;
}

float light_table_probability(const struct light_table *t, uint32_t light)
{
    double begin = light > 0 ? t->choices[light - 1].end : 0.0;
    return (float)(t->choices[light].end - begin);
}
//< selection.pick

void light_table_free(struct light_table *t)
{
    mem_free(t->choices);
    t->choices = NULL;
    t->count = 0;
}
#else
/* TODO(light_selection): give each light a weight, turn the weights into
 * probabilities, and pick by them; keep what you need in a struct light_choice
 * of your own. selection.h says what must hold. Until then every light is as
 * likely as any other. */
struct light_table light_table_make(const struct light lights[], uint32_t count,
                                    bool by_power, float scene_radius)
{
    struct light_table t = {count, NULL};
    (void)lights, (void)by_power, (void)scene_radius;
    TODO_WARN("07 several-lights", "every light is as likely");
    return t;
}

uint32_t light_table_pick(const struct light_table *t, float random,
                          float *probability)
{
    uint32_t light = (uint32_t)((double)random * t->count);
    *probability = light_table_probability(t, light);
    return light;
}

float light_table_probability(const struct light_table *t, uint32_t light)
{
    (void)light;
    return t->count > 0 ? 1.0f / (float)t->count : 0.0f;
}

void light_table_free(struct light_table *t)
{
    t->count = 0;
}
#endif
//< selection
