/* selection.c - lights in the order of their probability, the likeliest first,
 * so that a walk along them is short. */
#include "lights/selection.h"

#include <stdlib.h>

#include "base/memory.h"

struct light_choice {
    double probability; /* of the light with this index */
    double end;         /* of the light at this place of the order */
    uint32_t order;
    double key; /* the probability again, while it is sorted */
};

static int likelier_first(const void *a, const void *b)
{
    const struct light_choice *x = a, *y = b;
    if (x->key != y->key)
        return x->key < y->key ? 1 : -1;
    return (x->order > y->order) - (x->order < y->order);
}

static void find_probabilities(double p[], const struct light lights[],
                               uint32_t count, float radius)
{
    double mean = 0.0, sum = 0.0;
    for (uint32_t i = 0; i < count; i++)
        mean += (p[i] = (double)light_power(&lights[i], radius)) / count;
    for (uint32_t i = 0; i < count; i++) {
        if (p[i] > 0.0)
            p[i] = fmax(p[i], (double)LIGHT_SMALLEST_SHARE * mean);
        sum += p[i];
    }
    for (uint32_t i = 0; i < count; i++)
        p[i] = sum > 0.0 ? p[i] / sum : 1.0 / count;
}

static void sort_choices(struct light_choice c[], const double p[],
                         uint32_t count)
{
    double end = 0.0;
    for (uint32_t i = 0; i < count; i++) {
        c[i].order = i;
        c[i].key = p[i];
    }
    qsort(c, count, sizeof *c, likelier_first);
    for (uint32_t i = 0; i < count; i++) {
        end += c[i].key;
        c[i].end = end;
        c[i].probability = p[i];
    }
}

struct light_table light_table_make(const struct light lights[], uint32_t count,
                                    bool by_power, float scene_radius)
{
    struct light_table t = {count, mem_alloc(count, sizeof *t.choices)};
    double *p = mem_alloc(count, sizeof *p);
    for (uint32_t i = 0; i < count; i++)
        p[i] = 1.0 / count;
    if (by_power)
        find_probabilities(p, lights, count, scene_radius);
    sort_choices(t.choices, p, count);
    mem_free(p);
    return t;
}

uint32_t light_table_pick(const struct light_table *t, float random,
                          float *probability)
{
    uint32_t place = 0;
    while (place + 1 < t->count && t->choices[place + 1].key > 0.0 &&
           t->choices[place].end <= (double)random)
        place++;
    uint32_t light = t->choices[place].order;
    *probability = (float)t->choices[light].probability;
    return light;
}

float light_table_probability(const struct light_table *t, uint32_t light)
{
    return (float)t->choices[light].probability;
}

void light_table_free(struct light_table *t)
{
    mem_free(t->choices);
    t->choices = NULL;
    t->count = 0;
}
