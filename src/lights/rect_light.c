/* rect_light.c - assignment 08: light from an area.
 *
 * The contract is in rect_light.h. */
#include "lights/rect_light.h"

#include "base/todo.h"

//> rect_light.place: Pick a place on the rectangle
vec3 rect_light_place(const struct rect *rect, vec2 random)
{
#ifndef TODO_rect_light_place
    vec3 along_x = vec3_step(rect->center, random.x - 0.5f, rect->side_x);
    return vec3_step(along_x, random.y - 0.5f, rect->side_y);
#else
    /* TODO(rect_light_place): spread the places evenly over the rectangle.
     * Until then it is lit from one point, and all shadows are hard. */
    (void)random;
    TODO_WARN("08 area light", "all light comes from the lamp's centre");
    return rect->center;
#endif
}
//< rect_light.place

//> rect_light.pdf: Turn a density of places into one of directions
float area_light_pdf(vec3 point, vec3 on_light, vec3 normal, float area)
{
#ifndef TODO_area_light_pdf
    /* A patch dA covers dA cosine / distance^2 steradians. */
    vec3 to_point = vec3_sub(point, on_light);
    float distance = vec3_length(to_point);
    float height = vec3_dot(normal, to_point); /* cosine x distance */
    if (!(height > 0.0f))
        return 0.0f;
    return distance * distance * distance / (height * area);
#else
    /* TODO(area_light_pdf): the density of directions, per steradian, that
     * belongs to 1 / area. Until then the lamp is as bright as a point light of
     * the same power (assignment 05): its area x pi x radiance. */
    (void)normal;
    TODO_WARN("08 area light", "a lamp is as bright as a point light");
    vec3 way = vec3_sub(point, on_light);
    return 4.0f * vec3_dot(way, way) / area;
#endif
}
//< rect_light.pdf

//> rect_light.emitted: Shine on the normal's side
rgb area_light_emitted(rgb radiance, vec3 normal, vec3 outgoing)
{
#ifndef TODO_area_light_emitted
    return vec3_dot(normal, outgoing) > 0.0f ? radiance : rgb_grey(0.0f);
#else
    /* TODO(area_light_emitted): dark on the back. */
    (void)normal, (void)outgoing;
    TODO_WARN("08 area light", "lamps shine on both sides");
    return radiance;
#endif
}
//< rect_light.emitted
