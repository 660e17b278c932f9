/* intersection_test.h - assignment 04: what is seen through clear surfaces.
 *
 * The simplest integrator that shows whether intersections are right: each
 * camera ray is followed through clear surfaces to the first that is not
 * clear, and that one is lit by the lights without extent, with shadows. */
#ifndef RAYBOOK_INTEGRATORS_INTERSECTION_TEST_H
#define RAYBOOK_INTEGRATORS_INTERSECTION_TEST_H

#include "integrators/tracer.h"

/* The radiance that comes back along the ray r (W m^-2 sr^-1). d is r's
 * differential; it travels along with the ray.
 *
 * tracer_hit finds the surface that a ray meets, `v` below. What happens there:
 *
 *   none is met             The ray leaves the scene. The answer is black,
 *                           whatever the environment.
 *   no material             (v.object->material is NULL: a lamp may be so.)
 *                           The answer is black: what lamps emit is not seen.
 *   clear                   (material_is_specular.) bounce turns r and d into
 *                           the ray that goes on, already off the surface; the
 *                           radiance found further on counts times way.weight,
 *                           the product of the weights of all surfaces passed.
 *                           If bounce returns false the answer is black.
 *   any other material      The way ends. delta_lighting is the light there.
 *
 * t->scene->integrator.max_depth, 1 or more, is how many clear surfaces a ray
 * may go on from, through them or mirrored: where it meets one more the answer
 * is black. So with 1 a glass ball is black, and from 2 on one can see through
 * it.
 *
 * Not asked: light that a clear surface gathers (delta_lighting is black
 * there), lights that hide behind glass, Fresnel's shares, random numbers:
 * bounce and delta_lighting see to all that. Nothing is to be allocated. The
 * function runs in many threads at once: no variable of the file may change. */
rgb intersection_test_radiance(const struct tracer *t, ray r,
                               struct ray_differential d);

#endif
