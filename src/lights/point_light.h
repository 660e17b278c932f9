/* point_light.h - assignment 05: how a point light fades with the distance. */
#ifndef RAYBOOK_LIGHTS_POINT_LIGHT_H
#define RAYBOOK_LIGHTS_POINT_LIGHT_H

#include "base/rgb.h"

/* The irradiance (W m^-2) that a point light gives a surface which faces it.
 *
 * flux: all the power that the light sends out (W, per colour, none below 0),
 * the same in every direction. distance: from the light to the surface (m),
 * above 0; its square is a finite float that is not 0. The answer is
 *
 *     flux / (4 pi distance^2)
 *
 * to about one part in 10^5: the flux that goes through each square metre of
 * a sphere of that radius around the light. What the surface does with the
 * light, and whether it faces it at all, is not asked here. */
rgb point_light_irradiance(rgb flux, float distance);

#endif
