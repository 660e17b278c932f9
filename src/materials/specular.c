/* specular.c - see specular.h. */
#include "materials/specular.h"

#include "materials/mirror.h"
#include "materials/refraction.h"
#include "materials/sides.h"

static bool normals_agree(const struct surface *s, vec3 outgoing, vec3 incoming)
{
    return surface_side(s, outgoing) != 0 && surface_side(s, incoming) != 0;
}

vec3 specular_normal(const struct surface *s, vec3 outgoing)
{
    bool agree = surface_side(s, outgoing) != 0;
    return agree ? s->shading_normal : s->geometric_normal;
}

vec3 specular_reflect(const struct surface *s, vec3 outgoing)
{
    vec3 incoming = mirror_direction(s->shading_normal, outgoing);
    if (!normals_agree(s, outgoing, incoming))
        incoming = mirror_direction(s->geometric_normal, outgoing);
    return vec3_normalize(incoming);
}

bool specular_refract(const struct surface *s, vec3 outgoing,
                      float eta_inside_over_outside, vec3 *incoming)
{
    bool passes = refraction_direction(s->shading_normal, outgoing,
                                       eta_inside_over_outside, incoming);
    if (normals_agree(s, outgoing, *incoming))
        return passes;
    return refraction_direction(s->geometric_normal, outgoing,
                                eta_inside_over_outside, incoming);
}
