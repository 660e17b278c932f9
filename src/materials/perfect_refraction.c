/* perfect_refraction.c - see perfect_refraction.h. */
#include "materials/perfect_refraction.h"

#include "materials/specular.h"

bool perfect_refraction_sample(const struct material *m,
                               const struct surface *s, vec3 outgoing,
                               struct scatter *out)
{
    out->transmitted = specular_refract(s, outgoing, m->eta, &out->incoming);
    out->weight = rgb_grey(1.0f);
    out->pdf = 0.0f;
    out->specular = true;
    return true;
}
