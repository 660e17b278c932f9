/* glass.c - see glass.h. */
#include "materials/glass.h"

#include "materials/fresnel.h"
#include "materials/specular.h"

bool glass_sample(const struct material *m, const struct surface *s,
                  vec3 outgoing, const float random[3], struct scatter *out)
{
    vec3 normal = specular_normal(s, outgoing);
    float cosine = vec3_dot(outgoing, normal);
    float eta_beyond = cosine >= 0.0f ? m->eta : 1.0f / m->eta;
    float share = fresnel_dielectric(fabsf(cosine), eta_beyond);
    out->transmitted = false;
    if (random[2] < share)
        out->incoming = specular_reflect(s, outgoing);
    else
        out->transmitted =
            specular_refract(s, outgoing, m->eta, &out->incoming);
    float factor = 1.0f / (eta_beyond * eta_beyond);
    out->weight =
        out->transmitted ? rgb_scale(m->transmittance, factor) : m->reflectance;
    out->pdf = 0.0f;
    out->specular = true;
    return !rgb_is_black(out->weight);
}
