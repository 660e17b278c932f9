/* sphere.h - where a ray meets a sphere. */
#ifndef RAYBOOK_SHAPES_SPHERE_H
#define RAYBOOK_SHAPES_SPHERE_H

#include <stdbool.h>

#include "base/box.h"
#include "base/ray.h"
#include "shapes/surface.h"

/* radius > 0. The pole is +z. */
struct sphere {
    vec3 center;
    float radius;
};

/* The nearest t in [t_min, t_max] at which the ray meets the sphere, from
 * outside or inside. On a miss returns false and leaves *t alone.
 *
 * Source: E. Haines et al., "Precision Improvements for Ray/Sphere
 * Intersection", Ray Tracing Gems, 2019, chapter 7: small spheres far away
 * and large ones close by keep their digits. */
bool sphere_intersect(const struct sphere *s, const ray *r, float *t);

/* The surface at a hit: position on the sphere, outward normal, u = phi / 2pi
 * from +x towards +y, v = theta / pi from +z, and their differentials. */
void sphere_surface(const struct sphere *s, const ray *r, float t,
                    struct surface *out);

aabb sphere_bounds(const struct sphere *s);

#endif
