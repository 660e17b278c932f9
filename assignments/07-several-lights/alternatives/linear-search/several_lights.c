/* several_lights.c - channel by channel, in double precision. */
#include "integrators/several_lights.h"

rgb all_lights(const struct asking *a, uint32_t count)
{
    double r = 0.0, g = 0.0, b = 0.0;
    for (uint32_t i = 0; i < count; i++) {
        rgb part = ask_light(a, i);
        r += (double)part.r;
        g += (double)part.g;
        b += (double)part.b;
    }
    return rgb_make((float)r, (float)g, (float)b);
}

rgb one_light(const struct asking *a, const struct light_table *table,
              float random)
{
    float p;
    rgb part = ask_light(a, light_table_pick(table, random, &p));
    return rgb_make(part.r / p, part.g / p, part.b / p);
}
