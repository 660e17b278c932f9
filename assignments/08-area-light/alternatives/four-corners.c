/* rect_light.c - assignment 08: a blend of the four corners, its numbers the
 * other way round; the cosine over the squared distance as one quotient. */
#include "lights/rect_light.h"

static vec3 blend(vec3 a, vec3 b, float amount)
{
    return vec3_add(vec3_scale(a, 1.0f - amount), vec3_scale(b, amount));
}

vec3 rect_light_place(const struct rect *rect, vec2 random)
{
    vec3 x = vec3_scale(rect->side_x, 0.5f), y = vec3_scale(rect->side_y, 0.5f);
    vec3 right = vec3_add(rect->center, x), left = vec3_sub(rect->center, x);
    vec3 upper = blend(vec3_add(right, y), vec3_add(left, y), random.y);
    vec3 lower = blend(vec3_sub(right, y), vec3_sub(left, y), random.y);
    return blend(upper, lower, random.x);
}

/* The patch's share of the sphere around the point, per unit of its area. */
static float steradians_per_area(vec3 point, vec3 on_light, vec3 normal)
{
    vec3 to_point = vec3_sub(point, on_light);
    float squared = vec3_dot(to_point, to_point);
    if (squared == 0.0f)
        return 0.0f;
    float cosine = vec3_dot(to_point, normal) / sqrtf(squared);
    return fmaxf(cosine, 0.0f) / squared;
}

float area_light_pdf(vec3 point, vec3 on_light, vec3 normal, float area)
{
    float steradians = steradians_per_area(point, on_light, normal);
    float per_area = 1.0f / area;
    return steradians > 0.0f ? per_area / steradians : 0.0f;
}

rgb area_light_emitted(rgb radiance, vec3 normal, vec3 outgoing)
{
    bool in_front = vec3_dot(vec3_normalize(outgoing), normal) > 0.0f;
    return in_front ? radiance : rgb_grey(0.0f);
}
