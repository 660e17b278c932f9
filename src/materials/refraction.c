/* refraction.c - assignment 04: light through a clear boundary.
 *
 * The contract is in refraction.h. */
#include "materials/refraction.h"

#include "base/todo.h"

//> refraction.direction: Find where light came from through a boundary
bool refraction_direction(vec3 normal, vec3 outgoing,
                          float eta_inside_over_outside, vec3 *incoming)
{
#ifndef TODO_refraction_direction
    //> refraction.direction.side: Turn the normal to outgoing's side
    bool outside = vec3_dot(outgoing, normal) >= 0.0f;
    vec3 n = outside ? normal : vec3_negate(normal);
    float cosine = vec3_dot(outgoing, n);
    /* The index of refraction here over the one beyond the boundary. */
    float ratio =
        outside ? 1.0f / eta_inside_over_outside : eta_inside_over_outside;
    //< refraction.direction.side
    //> refraction.direction.snell: Apply Snell's law
    /* The squared cosine beyond is 1 - ratio^2 (1 - cosine^2). Written so, no
     * digits are lost where the ratio is near 1 and the angle grazes. */
    float cosine2_beyond =
        (1.0f - ratio) * (1.0f + ratio) + (ratio * cosine) * (ratio * cosine);
    bool passes = cosine2_beyond > 0.0f;
    //< refraction.direction.snell
    //> refraction.direction.build: Put the direction together
    vec3 along = vec3_step(outgoing, -cosine, n); /* in the boundary's plane */
    vec3 direction = vec3_step(vec3_negate(along), cosine, n);
    if (passes)
        direction =
            vec3_step(vec3_scale(along, -ratio), -sqrtf(cosine2_beyond), n);
    *incoming = vec3_normalize(direction);
    return passes;
    //< refraction.direction.build
#else
    /* TODO(refraction_direction): decide from the normal which side outgoing
     * is on, apply Snell's law, and where it has no solution mirror outgoing.
     * refraction.h says what must hold. Until then glass bends nothing. */
    (void)normal, (void)eta_inside_over_outside;
    TODO_WARN("04 refraction", "light goes straight through");
    *incoming = vec3_negate(outgoing);
    return true;
#endif
}
//< refraction.direction
