/* point_light.h - a light without size. */
#ifndef RAYBOOK_LIGHTS_POINT_LIGHT_H
#define RAYBOOK_LIGHTS_POINT_LIGHT_H

#include "base/rgb.h"
#include "base/vec.h"

/* flux: all the power that it sends out, in watts, spread evenly over the
 * sphere of directions. */
struct point_light {
    vec3 position;
    rgb flux;
};

/* The irradiance (W/m^2) that the light gives a surface at `point` that faces
 * it and sees it: flux / (4 pi d^2). *direction becomes the unit vector from
 * the point to the light. At the light itself the answer is 0, and *direction
 * is some unit vector. */
rgb point_light_irradiance(const struct point_light *light, vec3 point,
                           vec3 *direction);

#endif
