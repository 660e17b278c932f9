/* selection.h - assignment 07: one light out of many. */
#ifndef RAYBOOK_LIGHTS_SELECTION_H
#define RAYBOOK_LIGHTS_SELECTION_H

#include <stdint.h>

#include "lights/light.h"

/* What a table holds for picking: yours, to be defined in selection.c. */
struct light_choice;

/* How likely each of count lights is to be picked: lights 0 to count - 1. Once
 * made it does not change, and many threads may ask it. */
struct light_table {
    uint32_t count;
    struct light_choice *choices; /* owned by the table; NULL is fine */
};

/* Power is only an estimate: a faint light may be the only one that reaches a
 * corner, and what is picked with a chance of p counts 1 / p times. So no light
 * that has any power gets less than this part of the mean of all weights. */
#define LIGHT_SMALLEST_SHARE 1e-3f

/* The table of these lights, which are only read while it is made.
 *
 * by_power false: every light is as likely. by_power true: each light has a
 * weight, and is picked in proportion to it. The weight is its power,
 * light_power(light, scene_radius), in W, never below 0; then one that is not
 * 0, but below LIGHT_SMALLEST_SHARE times the mean of the count powers, is
 * raised to that. A light without power is never picked; if none has any,
 * all are as likely. Each probability is right to one part in 10^4.
 *
 * count may be 0; such a table is only ever released. The sum of the powers
 * is a finite float. Memory comes from mem_alloc (base/memory.h) and is
 * released by light_table_free. */
struct light_table light_table_make(const struct light lights[], uint32_t count,
                                    bool by_power, float scene_radius);

/* Picks a light with a number in [0, 1). Returns its index, below count, and
 * in *probability how likely that was, above 0. Over all random numbers each
 * light is picked as often as light_table_probability says; which numbers
 * pick which light is yours to choose. count is not 0. */
uint32_t light_table_pick(const struct light_table *t, float random,
                          float *probability);

/* How likely a light, an index below count, is to be picked: 0 to 1. */
float light_table_probability(const struct light_table *t, uint32_t light);

/* Releases what the table owns, and may be called again: the count is 0 and
 * choices NULL afterwards, as in a table that is all zeros. */
void light_table_free(struct light_table *t);

#endif
