/* point_light.c - assignment 05: how a point light fades with the distance.
 *
 * The contract is in point_light.h. */
#include "lights/point_light.h"

#include "base/constants.h"
#include "base/todo.h"

//> point_light: Spread the flux over a sphere
rgb point_light_irradiance(rgb flux, float distance)
{
#ifndef TODO_point_light
    float inverse_square = 1.0f / (distance * distance);
    return rgb_scale(flux, inverse_square / (4.0f * PI));
#else
    /* TODO(point_light): spread the flux evenly over the sphere whose radius is
     * the distance; point_light.h has the unit of each number. Until then a
     * lamp is as bright at the far end of the room as beside you. */
    (void)distance;
    TODO_WARN("05 direct-lighting", "point lights do not fade");
    return rgb_scale(flux, 0.01f);
#endif
}
//< point_light
