/* direct_lighting.c - assignment 05: what one light makes of a point.
 *
 * The contract is in direct_lighting.h. */
#include "integrators/direct_lighting.h"

#include "base/todo.h"

//> direct_light: Compute what one light makes of a point
#ifndef TODO_direct_light
//> direct_light.hidden: Ask whether the light is hidden
static bool hidden(const struct scene *scene, const struct vertex *v,
                   const struct light_sample *s)
{
    if (s->infinite)
        return scene_direction_blocked(scene, &v->surface, s->direction);
    return scene_segment_blocked(scene, &v->surface, s->target);
}
//< direct_light.hidden
#endif

rgb direct_light(const struct scene *scene, const struct vertex *v,
                 const struct light_sample *s)
{
#ifndef TODO_direct_light
    //> direct_light.sum: Multiply what the light, the angle and the surface do
    rgb scattered = material_eval(v->object->material, &v->surface, v->outgoing,
                                  s->direction);
    /* Most hidden points face away from the light: ask the cheap one first. */
    if (rgb_is_black(scattered) || hidden(scene, v, s))
        return rgb_grey(0.0f);
    float cosine = fabsf(vec3_dot(s->direction, v->surface.shading_normal));
    return rgb_scale(rgb_mul(scattered, s->radiance), cosine / s->pdf);
    //< direct_light.sum
#else
    /* TODO(direct_light): find out whether the light is hidden; if it is not,
     * multiply what the material does with it, its radiance and the cosine,
     * and divide by the density. direct_lighting.h says what must hold. Until
     * then surfaces show their colour alone: flat, without light and shadow. */
    (void)s;
    TODO_WARN("05 direct-lighting", "flat: the material's albedo");
    return rgb_scale(material_albedo(v->object->material, &v->surface),
                     1.0f / (float)scene->light_count);
#endif
}
//< direct_light
