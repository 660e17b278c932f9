/* point_light.c - see point_light.h. */
#include "lights/point_light.h"

#include "base/constants.h"

rgb point_light_irradiance(const struct point_light *light, vec3 point,
                           vec3 *direction)
{
    vec3 to_light = vec3_sub(light->position, point);
    float distance = vec3_length(to_light);
    *direction = vec3_make(0.0f, 0.0f, 1.0f);
    if (!(distance > 0.0f))
        return rgb_grey(0.0f);
    *direction = vec3_scale(to_light, 1.0f / distance);
    return rgb_scale(light->flux, 1.0f / (4.0f * PI * distance * distance));
}
