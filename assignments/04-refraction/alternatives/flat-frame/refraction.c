/* refraction.c - in the plane of incidence, with coordinates along the boundary
 * and across it; helpers of its own, and doubles for the square root. */
#include "materials/refraction.h"

/* Where a direction lies: across >= 0 is along n, along >= 0 along tangent. */
struct in_plane {
    vec3 n, tangent;
    double across, along;
};

static struct in_plane flatten(vec3 normal, vec3 direction)
{
    struct in_plane p;
    p.across = (double)vec3_dot(normal, direction);
    p.n = normal;
    p.tangent = vec3_sub(direction, vec3_scale(normal, (float)p.across));
    p.along = (double)vec3_length(p.tangent);
    if (p.along > 0.0)
        p.tangent = vec3_scale(p.tangent, (float)(1.0 / p.along));
    return p;
}

static vec3 unflatten(const struct in_plane *p, double across, double along)
{
    return vec3_add(vec3_scale(p->n, (float)across),
                    vec3_scale(p->tangent, (float)along));
}

bool refraction_direction(vec3 normal, vec3 outgoing,
                          float eta_inside_over_outside, vec3 *incoming)
{
    struct in_plane p = flatten(normal, outgoing);
    double eta = (double)eta_inside_over_outside;
    double sine = p.across < 0.0 ? p.along * eta : p.along / eta;
    if (sine >= 1.0) {
        *incoming = unflatten(&p, p.across, -p.along);
        return false;
    }
    double cosine = sqrt(1.0 - sine * sine);
    *incoming = unflatten(&p, p.across < 0.0 ? cosine : -cosine, -sine);
    return true;
}
