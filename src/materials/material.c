/* material.c - see material.h. */
#include "materials/material.h"

#include "base/constants.h"

/* Both directions above the surface, or both below it and that counts too. A
 * direction must agree with the true and with the smooth normal, or light
 * would leak through at the rim of a smooth mesh. */
static bool reflects(const struct material *m, const struct surface *s,
                     vec3 outgoing, vec3 incoming)
{
    float side = 1.0f;
    if (m->two_sided && vec3_dot(outgoing, s->geometric_normal) < 0.0f)
        side = -1.0f;
    return side * vec3_dot(outgoing, s->geometric_normal) > 0.0f &&
           side * vec3_dot(incoming, s->geometric_normal) > 0.0f &&
           side * vec3_dot(incoming, s->shading_normal) > 0.0f;
}

rgb material_eval(const struct material *m, const struct surface *s,
                  vec3 outgoing, vec3 incoming)
{
    if (!reflects(m, s, outgoing, incoming))
        return rgb_grey(0.0f);
    return rgb_scale(material_albedo(m, s), 1.0f / PI);
}

rgb material_albedo(const struct material *m, const struct surface *s)
{
    return texture_color(m->albedo, s->uv);
}
