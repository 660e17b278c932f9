/* rect_light.c - assignment 08: the rectangle as two triangles. The first
 * number picks one of them and is stretched; a square root spreads the places
 * evenly in it (G. Turk, "Generating Random Points in Triangles", Graphics
 * Gems, 1990). */
#include "lights/rect_light.h"

static vec3 corner(const struct rect *rect, float x, float y)
{
    vec3 along = vec3_step(rect->center, x, rect->side_x);
    return vec3_step(along, y, rect->side_y);
}

static vec3 in_triangle(vec3 a, vec3 b, vec3 c, float s, float t)
{
    float root = sqrtf(s);
    vec3 p = vec3_scale(a, 1.0f - root);
    p = vec3_step(p, root * (1.0f - t), b);
    return vec3_step(p, root * t, c);
}

vec3 rect_light_place(const struct rect *rect, vec2 random)
{
    vec3 a = corner(rect, -0.5f, -0.5f), b = corner(rect, 0.5f, -0.5f);
    vec3 c = corner(rect, 0.5f, 0.5f), d = corner(rect, -0.5f, 0.5f);
    if (random.x < 0.5f)
        return in_triangle(a, b, c, 2.0f * random.x, random.y);
    return in_triangle(a, c, d, 2.0f * random.x - 1.0f, random.y);
}

float area_light_pdf(vec3 point, vec3 on_light, vec3 normal, float area)
{
    vec3 to_point = vec3_sub(point, on_light);
    float distance = vec3_length(to_point);
    float height = vec3_dot(to_point, normal);
    float steradians = area * height / (distance * distance * distance);
    return height > 0.0f && steradians > 0.0f ? 1.0f / steradians : 0.0f;
}

rgb area_light_emitted(rgb radiance, vec3 normal, vec3 outgoing)
{
    float side = vec3_dot(outgoing, normal) > 0.0f ? 1.0f : 0.0f;
    return rgb_make(side * radiance.r, side * radiance.g, side * radiance.b);
}
