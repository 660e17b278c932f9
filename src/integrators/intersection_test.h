/* intersection_test.h - assignment 04: what is seen, lit directly.
 *
 * The simplest integrator that shows whether intersections are right: each
 * camera ray is followed through clear materials to the first surface that is
 * not, and that one is lit by the lights without extent, with shadows. */
#ifndef RAYBOOK_INTEGRATORS_INTERSECTION_TEST_H
#define RAYBOOK_INTEGRATORS_INTERSECTION_TEST_H

#include "integrators/tracer.h"

/* The radiance that comes back along the ray (W m^-2 sr^-1). Black where the
 * ray leaves the scene, meets a light without a material, or is still in
 * clear materials after the scene's max_depth of them. Any object, glass too,
 * blocks a light; the radiance is not weighted by Fresnel's shares unless the
 * material itself does so. */
rgb intersection_test_radiance(const struct tracer *t, ray r,
                               struct ray_differential d);

#endif
