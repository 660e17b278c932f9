/* several_lights.c - the sum by recursion: the last light, and those before
 * it. */
#include "integrators/several_lights.h"

rgb all_lights(const struct asking *a, uint32_t count)
{
    if (count == 0)
        return rgb_grey(0.0f);
    rgb last = ask_light(a, count - 1);
    return rgb_add(last, all_lights(a, count - 1));
}

rgb one_light(const struct asking *a, const struct light_table *table,
              float random)
{
    float ignored;
    uint32_t light = light_table_pick(table, random, &ignored);
    float weight = 1.0f / light_table_probability(table, light);
    return rgb_scale(ask_light(a, light), weight);
}
