/* refraction.c - Bec's method ("A faster refraction formula", Ray Tracing News
 * 10(1), 1997): few operations, a normal that is turned by the sign of w. */
#include "materials/refraction.h"

bool refraction_direction(vec3 normal, vec3 outgoing,
                          float eta_inside_over_outside, vec3 *incoming)
{
    float cosine = vec3_dot(normal, outgoing);
    float ratio = cosine < 0.0f ? eta_inside_over_outside
                                : 1.0f / eta_inside_over_outside;
    float w = ratio * cosine;
    float k2 = 1.0f + (w - ratio) * (w + ratio);
    bool passes = !(k2 < 0.0f);
    vec3 found;
    if (passes) {
        float k = copysignf(sqrtf(k2), cosine);
        found =
            vec3_sub(vec3_scale(normal, w - k), vec3_scale(outgoing, ratio));
    } else {
        found = vec3_sub(vec3_scale(normal, 2.0f * cosine), outgoing);
    }
    *incoming = vec3_normalize(found);
    return passes;
}
