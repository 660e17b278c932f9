/* point_light.c - the radiant intensity first, then its fading. */
#include "lights/point_light.h"

#include "base/constants.h"

rgb point_light_irradiance(rgb flux, float distance)
{
    rgb intensity = rgb_scale(flux, 0.25f / PI); /* W sr^-1 */
    return rgb_scale(intensity, powf(distance, -2.0f));
}
