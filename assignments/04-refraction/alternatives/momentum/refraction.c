/* refraction.c - the wave vector: its length is the index of where it is, and
 * its part along the boundary is the same on both sides. */
#include "materials/refraction.h"

bool refraction_direction(vec3 normal, vec3 outgoing,
                          float eta_inside_over_outside, vec3 *incoming)
{
    bool inside = vec3_dot(normal, outgoing) < 0.0f;
    float here = inside ? eta_inside_over_outside : 1.0f;
    float there = inside ? 1.0f : eta_inside_over_outside;

    vec3 wave = vec3_scale(outgoing, here);
    float across = vec3_dot(wave, normal);
    vec3 along = vec3_step(wave, -across, normal);
    /* There: there^2 = |along|^2 + across^2. */
    float rest = there * there - vec3_dot(along, along);
    if (rest > 0.0f) {
        float beyond = inside ? -sqrtf(rest) : sqrtf(rest);
        vec3 back = vec3_step(along, beyond, normal);
        *incoming = vec3_normalize(vec3_negate(back));
        return true;
    }
    *incoming = vec3_normalize(vec3_step(vec3_negate(along), across, normal));
    return false;
}
