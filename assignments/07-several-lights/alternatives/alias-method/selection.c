/* selection.c - the alias method: each of count equal columns of [0, 1) is
 * shared by at most two lights, so that a pick takes one comparison.
 *
 * M. Vose, "A Linear Algorithm for Generating Random Numbers with a Given
 * Distribution", IEEE Transactions on Software Engineering 17(9), 1991. */
#include "lights/selection.h"

#include "base/memory.h"

struct light_choice {
    double probability;
    double own;     /* which part of its column is the light's own */
    uint32_t other; /* whose the rest is */
};

static double total_power(const struct light lights[], uint32_t count,
                          float radius, double powers[])
{
    double total = 0.0;
    for (uint32_t i = 0; i < count; i++) {
        powers[i] = (double)light_power(&lights[i], radius);
        total += powers[i];
    }
    return total;
}

static void weigh(struct light_choice c[], const double powers[],
                  uint32_t count, double total)
{
    double least = (double)LIGHT_SMALLEST_SHARE * total / count, sum = 0.0;
    for (uint32_t i = 0; i < count; i++) {
        c[i].probability = powers[i];
        if (powers[i] > 0.0 && powers[i] < least)
            c[i].probability = least;
        sum += c[i].probability;
    }
    for (uint32_t i = 0; i < count; i++)
        c[i].probability = sum > 0.0 ? c[i].probability / sum : 1.0 / count;
}

/* Fills the columns: one that is not full takes what it lacks from one that
 * has too much. */
static void share_columns(struct light_choice c[], uint32_t count)
{
    uint32_t *poor = mem_alloc(count, sizeof *poor);
    uint32_t *rich = mem_alloc(count, sizeof *rich);
    uint32_t poor_count = 0, rich_count = 0;
    for (uint32_t i = 0; i < count; i++) {
        c[i].own = c[i].probability * count;
        c[i].other = i;
        if (c[i].own < 1.0)
            poor[poor_count++] = i;
        else
            rich[rich_count++] = i;
    }
    while (poor_count > 0 && rich_count > 0) {
        uint32_t taker = poor[--poor_count], giver = rich[rich_count - 1];
        c[taker].other = giver;
        c[giver].own -= 1.0 - c[taker].own;
        if (c[giver].own < 1.0) {
            rich_count--;
            poor[poor_count++] = giver;
        }
    }
    mem_free(poor);
    mem_free(rich);
}

/* What rounding has left over belongs to the column's own light, unless that
 * one must not be picked. */
static void close_columns(struct light_choice c[], uint32_t count)
{
    uint32_t likely = 0;
    for (uint32_t i = 0; i < count; i++)
        if (c[i].probability > c[likely].probability)
            likely = i;
    for (uint32_t i = 0; i < count; i++)
        if (c[i].other == i && c[i].probability == 0.0)
            c[i].other = likely;
}

struct light_table light_table_make(const struct light lights[], uint32_t count,
                                    bool by_power, float scene_radius)
{
    struct light_table t = {count, NULL};
    if (count == 0)
        return t;
    double *powers = mem_alloc(count, sizeof *powers);
    t.choices = mem_alloc(count, sizeof *t.choices);
    double total = 0.0;
    if (by_power)
        total = total_power(lights, count, scene_radius, powers);
    weigh(t.choices, powers, count, total);
    share_columns(t.choices, count);
    close_columns(t.choices, count);
    mem_free(powers);
    return t;
}

uint32_t light_table_pick(const struct light_table *t, float random,
                          float *probability)
{
    double scaled = (double)random * t->count;
    uint32_t column = (uint32_t)scaled;
    const struct light_choice *c = &t->choices[column];
    uint32_t light = scaled - column < c->own ? column : c->other;
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
