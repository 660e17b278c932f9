/* surface.h - the point at which a ray met a shape, ready for shading. */
#ifndef RAYBOOK_SHAPES_SURFACE_H
#define RAYBOOK_SHAPES_SURFACE_H

#include "base/ray.h"

/* Everything in world space.
 *
 * geometric_normal is the true normal of the surface, of length one: it
 * decides which side a direction is on. shading_normal is the smooth one
 * (interpolated from the mesh's vertices), of length one and on the same
 * side: it decides how bright the point is. dp_du and dp_dv say how the point
 * moves with the texture coordinates. position_error bounds, for each
 * component, how far the computed position may be from the exact one. */
struct surface {
    vec3 position;
    vec3 position_error;
    vec3 geometric_normal;
    vec3 shading_normal;
    vec2 uv;
    vec3 dp_du, dp_dv;
};

/* The ray that leaves the surface along direction, up to t_max.
 *
 * It starts a little off the surface, on direction's side: just more than the
 * error that the position may carry, so that it cannot hit the surface that
 * it leaves. t = 0 is not in its range: a position may be exact, and then it
 * is not moved at all.
 *
 * Source: M. Pharr, W. Jakob, G. Humphreys, "Physically Based Rendering", 3rd
 * edition, section 3.9.5. */
ray surface_ray(const struct surface *s, vec3 direction, float t_max);

/* The same for the straight way to a point: t runs up to, not including, 1,
 * which is the point itself. */
ray surface_segment(const struct surface *s, vec3 point);

#endif
