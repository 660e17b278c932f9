/* rect_light.c - see rect_light.h. */
#include "lights/rect_light.h"

vec3 rect_light_place(const struct rect *rect, vec2 random)
{
    vec3 along_x = vec3_step(rect->center, random.x - 0.5f, rect->side_x);
    return vec3_step(along_x, random.y - 0.5f, rect->side_y);
}

/* A patch dA covers dA cosine / distance^2 steradians. */
float area_light_pdf(vec3 point, vec3 on_light, vec3 normal, float area)
{
    vec3 to_point = vec3_sub(point, on_light);
    float distance = vec3_length(to_point);
    float height = vec3_dot(normal, to_point); /* cosine x distance */
    if (!(height > 0.0f))
        return 0.0f;
    return distance * distance * distance / (height * area);
}

rgb area_light_emitted(rgb radiance, vec3 normal, vec3 outgoing)
{
    return vec3_dot(normal, outgoing) > 0.0f ? radiance : rgb_grey(0.0f);
}
