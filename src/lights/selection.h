/* selection.h - assignment 07: one light out of many. */
#ifndef RAYBOOK_LIGHTS_SELECTION_H
#define RAYBOOK_LIGHTS_SELECTION_H

#include <stdint.h>

#include "lights/light.h"
#include "sampling/distribution.h"

/* How likely each light of a scene is to be picked. Owns its table. */
struct light_table {
    uint32_t count;
    struct distribution_1d picks;
};

/* by_power false: every light is as likely. True: in proportion to
 * light_power, but none that has any power has a probability near 0: light that
 * is never picked is lost, and what is hardly ever picked is noise. If no light
 * has any power, all are as likely. Release with light_table_free. */
struct light_table light_table_make(const struct light lights[], uint32_t count,
                                    bool by_power, float scene_radius);

/* Picks a light with a number in [0, 1). Returns its index, and in
 * *probability how likely that was, above 0. count must not be 0. */
uint32_t light_table_pick(const struct light_table *t, float random,
                          float *probability);

/* How likely a light is to be picked. */
float light_table_probability(const struct light_table *t, uint32_t light);

void light_table_free(struct light_table *t);

#endif
