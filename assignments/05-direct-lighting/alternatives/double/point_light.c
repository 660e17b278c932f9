/* point_light.c - in double precision, by the area of the sphere. */
#include "lights/point_light.h"

rgb point_light_irradiance(rgb flux, float distance)
{
    const double pi = 3.14159265358979323846;
    double area = 4.0 * pi * (double)distance * (double)distance;
    return rgb_make((float)((double)flux.r / area),
                    (float)((double)flux.g / area),
                    (float)((double)flux.b / area));
}
