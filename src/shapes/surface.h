/* surface.h - the point at which a ray met a shape, ready for shading. */
#ifndef RAYBOOK_SHAPES_SURFACE_H
#define RAYBOOK_SHAPES_SURFACE_H

#include "base/ray.h"
#include "base/ray_differential.h"

/* Everything in world space.
 *
 * geometric_normal is the true normal of the surface, of length one: it
 * decides which side a direction is on. shading_normal is the smooth one
 * (interpolated from the mesh's vertices), of length one and on the same
 * side: it decides how bright the point is. dp_du and dp_dv say how the point
 * moves with the texture coordinates, dn_du and dn_dv how the shading normal
 * turns. position_error bounds, for each component, how far the computed
 * position may be from the exact one. uv_dx and uv_dy are how the texture
 * coordinates change to the pixel on the right and the one below: zero until
 * surface_footprint has filled them. */
struct surface {
    vec3 position;
    vec3 position_error;
    vec3 geometric_normal;
    vec3 shading_normal;
    vec2 uv;
    vec3 dp_du, dp_dv;
    vec3 dn_du, dn_dv;
    vec2 uv_dx, uv_dy;
};

/* Fills uv_dx and uv_dy: the neighbouring pixels' rays are met with the
 * tangent plane, and the step between the points is expressed in dp_du and
 * dp_dv by least squares (a 2x2 system). Zero where a neighbour's ray runs
 * along the plane or dp_du and dp_dv do not span it.
 *
 * Source: Pharr, Jakob, Humphreys, "Physically Based Rendering", 4th edition,
 * section 10.1.1. */
void surface_footprint(struct surface *s, const ray *r,
                       const struct ray_differential *d);

/* The derivatives of the surface point itself: how far the point moves to the
 * neighbouring pixels, in the tangent plane. */
void surface_step(const struct surface *s, const ray *r,
                  const struct ray_differential *d, vec3 *dp_dx, vec3 *dp_dy);

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

/* The same for the straight way to a point. t = 1 is the point itself and not
 * in the range; the range ends as much earlier as rounding may move a surface
 * that holds the point, so that the point's own surface is not in the way. */
ray surface_segment(const struct surface *s, vec3 point);

#endif
