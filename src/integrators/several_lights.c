/* several_lights.c - assignment 07: the light of more than one lamp.
 *
 * The contract is in several_lights.h. */
#include "integrators/several_lights.h"

#include "base/todo.h"

//> several_lights: Let several lights shine
#ifndef TODO_several_lights
//> several_lights.all: Add up what all lights do
rgb all_lights(const struct asking *a, uint32_t count)
{
    rgb sum = rgb_grey(0.0f);
    for (uint32_t light = 0; light < count; light++)
        sum = rgb_add(sum, ask_light(a, light));
    return sum;
}
//< several_lights.all

//> several_lights.one: Let one light stand for all
rgb one_light(const struct asking *a, const struct light_table *table,
              float random)
{
    float probability;
    uint32_t light = light_table_pick(table, random, &probability);
    return rgb_scale(ask_light(a, light), 1.0f / probability);
}
//< several_lights.one
#else
/* TODO(several_lights): ask every light and add up; then ask one, picked from
 * the table, and let it stand for all. several_lights.h says what must hold.
 * Until then only the first lamp of a scene shines. */
static rgb first_light(const struct asking *a)
{
    TODO_WARN("07 several-lights", "the first light only");
    return ask_light(a, 0);
}

rgb all_lights(const struct asking *a, uint32_t count)
{
    return count > 0 ? first_light(a) : rgb_grey(0.0f);
}

rgb one_light(const struct asking *a, const struct light_table *table,
              float random)
{
    (void)table, (void)random;
    return first_light(a);
}
#endif
//< several_lights
