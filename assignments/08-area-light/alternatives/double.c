/* rect_light.c - assignment 08: all in double precision. */
#include "lights/rect_light.h"

static double at(float center, float x, float y, vec2 random)
{
    double a = (double)random.x - 0.5, b = (double)random.y - 0.5;
    return (double)center + a * (double)x + b * (double)y;
}

vec3 rect_light_place(const struct rect *rect, vec2 random)
{
    vec3 c = rect->center, x = rect->side_x, y = rect->side_y;
    return vec3_make((float)at(c.x, x.x, y.x, random),
                     (float)at(c.y, x.y, y.y, random),
                     (float)at(c.z, x.z, y.z, random));
}

float area_light_pdf(vec3 point, vec3 on_light, vec3 normal, float area)
{
    double x = (double)point.x - (double)on_light.x;
    double y = (double)point.y - (double)on_light.y;
    double z = (double)point.z - (double)on_light.z;
    double squared = x * x + y * y + z * z;
    double cosine = x * (double)normal.x + y * (double)normal.y;
    cosine = (cosine + z * (double)normal.z) / sqrt(squared);
    if (cosine > 0.0)
        return (float)(squared / cosine / (double)area);
    return 0.0f;
}

rgb area_light_emitted(rgb radiance, vec3 normal, vec3 outgoing)
{
    double side = (double)normal.x * (double)outgoing.x +
                  (double)normal.y * (double)outgoing.y +
                  (double)normal.z * (double)outgoing.z;
    return side > 0.0 ? radiance : rgb_grey(0.0f);
}
