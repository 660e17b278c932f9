/* several_lights.h - assignment 07: the light of more than one lamp. */
#ifndef RAYBOOK_INTEGRATORS_SEVERAL_LIGHTS_H
#define RAYBOOK_INTEGRATORS_SEVERAL_LIGHTS_H

#include "integrators/ask_light.h"

/* What the lights 0 to count - 1 add, all together, to the radiance that the
 * asking vertex sends towards its `outgoing`: ask_light asks one of them. Each
 * light is asked exactly once. Black if count is 0. */
rgb all_lights(const struct asking *a, uint32_t count);

/* The same by chance, from one light only: `random`, in [0, 1), picks it from
 * the table (light_table_pick), and it stands for all. So what it adds counts
 * as much more as it is picked more seldom: averaged over all `random`, the
 * answer is that of all_lights. Asks one light, once. The table's count is
 * not 0. */
rgb one_light(const struct asking *a, const struct light_table *table,
              float random);

#endif
