/* rect_light.c - assignment 08: the numbers from the other end, folded about
 * the middle; a guard against the light's own plane. */
#include "lights/rect_light.h"

/* From [0, 1) to [-1/2, 1/2]: the middle first, both halves in turn. */
static float fold(float number)
{
    float twice = 2.0f * number;
    return twice < 1.0f ? 0.5f * twice : 0.5f - 0.5f * twice;
}

vec3 rect_light_place(const struct rect *rect, vec2 random)
{
    vec3 offset = vec3_scale(rect->side_y, fold(random.x));
    offset = vec3_step(offset, fold(random.y), rect->side_x);
    return vec3_add(rect->center, offset);
}

float area_light_pdf(vec3 point, vec3 on_light, vec3 normal, float area)
{
    vec3 way = vec3_sub(point, on_light);
    float distance = vec3_length(way);
    if (!(distance > 0.0f))
        return 0.0f;
    float cosine = vec3_dot(vec3_scale(way, 1.0f / distance), normal);
    if (cosine < 1e-7f) /* below what the dot product is good for */
        return 0.0f;
    return distance / area * distance / cosine;
}

rgb area_light_emitted(rgb radiance, vec3 normal, vec3 outgoing)
{
    float cosine = vec3_dot(normal, outgoing) / vec3_length(outgoing);
    return cosine < 1e-7f ? rgb_grey(0.0f) : radiance;
}
