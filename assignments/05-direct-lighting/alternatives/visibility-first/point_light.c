/* point_light.c - divided twice by the distance. */
#include "lights/point_light.h"

#include "base/constants.h"

rgb point_light_irradiance(rgb flux, float distance)
{
    float k = 1.0f / distance / distance / 4.0f / PI;
    rgb irradiance = {flux.r * k, flux.g * k, flux.b * k};
    return irradiance;
}
