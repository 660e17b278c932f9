/* delta_lights.c - see delta_lights.h. */
#include "lights/delta_lights.h"

#include "base/minmax.h"
#include "lights/point_light.h"

/* All of a sample but its radiance, and how far away the light is. */
static bool look_at_light(const struct light *light, vec3 point,
                          struct light_sample *out, float *out_distance)
{
    vec3 way = vec3_sub(light->position, point);
    float distance = vec3_length(way);
    if (!(distance > 0.0f))
        return false;
    out->direction = vec3_scale(way, 1.0f / distance);
    out->target = light->position;
    out->infinite = false;
    out->delta = true;
    out->pdf = 1.0f;
    *out_distance = distance;
    return true;
}

bool point_light_sample(const struct light *light, vec3 point,
                        struct light_sample *out)
{
    float distance;
    if (!look_at_light(light, point, out, &distance))
        return false;
    out->radiance = point_light_irradiance(light->flux, distance);
    return true;
}

bool directional_light_sample(const struct light *light,
                              struct light_sample *out)
{
    out->direction = vec3_negate(light->direction);
    out->target = vec3_make(0.0f, 0.0f, 0.0f);
    out->infinite = true;
    out->delta = true;
    out->radiance = light->irradiance;
    out->pdf = 1.0f;
    return true;
}

float spot_light_falloff(const struct light *light, float cosine)
{
    float angle = acosf(float_max(-1.0f, float_min(1.0f, cosine)));
    if (angle <= light->beam_angle)
        return 1.0f;
    if (angle >= light->cutoff_angle)
        return 0.0f;
    return (light->cutoff_angle - angle) /
           (light->cutoff_angle - light->beam_angle);
}

bool spot_light_sample(const struct light *light, vec3 point,
                       struct light_sample *out)
{
    float distance;
    if (!look_at_light(light, point, out, &distance))
        return false;
    float cosine = -vec3_dot(light->direction, out->direction);
    float falloff = spot_light_falloff(light, cosine);
    out->radiance =
        rgb_scale(light->intensity, falloff * (1.0f / (distance * distance)));
    return true;
}
