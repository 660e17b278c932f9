/* refraction.c - Heckbert's vector formula (in Glassner, "An Introduction to
 * Ray Tracing", 1989), with the ray's direction in place of outgoing. */
#include "materials/refraction.h"

bool refraction_direction(vec3 normal, vec3 outgoing,
                          float eta_inside_over_outside, vec3 *incoming)
{
    vec3 i = vec3_negate(outgoing); /* the way the ray travels */
    vec3 n = normal;
    float eta = 1.0f / eta_inside_over_outside;
    float c1 = -vec3_dot(i, n);
    if (c1 < 0.0f) { /* from the inside */
        n = vec3_negate(n);
        c1 = -c1;
        eta = eta_inside_over_outside;
    }
    float cs2 = 1.0f - eta * eta * (1.0f - c1 * c1);
    if (cs2 < 0.0f) {
        *incoming = vec3_normalize(vec3_add(i, vec3_scale(n, 2.0f * c1)));
        return false;
    }
    *incoming = vec3_normalize(
        vec3_add(vec3_scale(i, eta), vec3_scale(n, eta * c1 - sqrtf(cs2))));
    return true;
}
