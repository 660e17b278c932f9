/* intersection_test.h - the simplest integrator: what is seen, lit directly.
 *
 * It shows whether intersections are right: each camera ray is followed to
 * the first diffuse surface, and that one is lit by the scene's point lights
 * with shadows. */
#ifndef RAYBOOK_INTEGRATORS_INTERSECTION_TEST_H
#define RAYBOOK_INTEGRATORS_INTERSECTION_TEST_H

#include "scene/scene.h"

/* The radiance that comes back along the ray (W m^-2 sr^-1); black where it
 * meets nothing. */
rgb intersection_test_radiance(const struct scene *scene, const ray *r);

#endif
