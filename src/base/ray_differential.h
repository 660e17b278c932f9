/* ray_differential.h - how a camera ray changes from pixel to pixel.
 *
 * A pixel is not a point: the ray through the next pixel hits the surface
 * elsewhere, and the distance says how large a patch of the surface (or of a
 * texture) the pixel sees. H. Igehy, "Tracing Ray Differentials", SIGGRAPH
 * 1999. */
#ifndef RAYBOOK_BASE_RAY_DIFFERENTIAL_H
#define RAYBOOK_BASE_RAY_DIFFERENTIAL_H

#include "base/vec.h"

/* The derivatives of a ray's origin and (unit) direction by the position on
 * the film: dx for one pixel to the right, dy for one pixel down. All zero: a
 * ray without extent, which sees single points. */
struct ray_differential {
    vec3 origin_dx, origin_dy;
    vec3 direction_dx, direction_dy;
};

/* Has the ray no extent? */
static inline bool ray_differential_is_zero(const struct ray_differential *d)
{
    vec3 origin = vec3_add(vec3_abs(d->origin_dx), vec3_abs(d->origin_dy));
    vec3 direction =
        vec3_add(vec3_abs(d->direction_dx), vec3_abs(d->direction_dy));
    vec3 sum = vec3_add(origin, direction);
    return sum.x + sum.y + sum.z == 0.0f;
}

#endif
