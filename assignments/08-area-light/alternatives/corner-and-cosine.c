/* rect_light.c - assignment 08: a corner and two sides; the cosine from unit
 * vectors, as a textbook has it. */
#include "lights/rect_light.h"

vec3 rect_light_place(const struct rect *rect, vec2 random)
{
    vec3 half = vec3_scale(vec3_add(rect->side_x, rect->side_y), 0.5f);
    vec3 corner = vec3_sub(rect->center, half);
    vec3 x = vec3_scale(rect->side_x, random.x);
    vec3 y = vec3_scale(rect->side_y, random.y);
    return vec3_add(vec3_add(corner, x), y);
}

float area_light_pdf(vec3 point, vec3 on_light, vec3 normal, float area)
{
    vec3 way = vec3_sub(on_light, point);
    float distance2 = vec3_dot(way, way);
    if (distance2 == 0.0f)
        return 0.0f;
    vec3 direction = vec3_scale(way, 1.0f / sqrtf(distance2));
    float cosine = vec3_dot(normal, vec3_negate(direction));
    if (cosine <= 0.0f)
        return 0.0f;
    return distance2 / (area * cosine);
}

rgb area_light_emitted(rgb radiance, vec3 normal, vec3 outgoing)
{
    if (vec3_dot(normal, outgoing) <= 0.0f)
        return rgb_make(0.0f, 0.0f, 0.0f);
    return radiance;
}
