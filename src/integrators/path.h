/* path.h - path tracing: all the light there is, one path at a time.
 *
 * J. Kajiya, "The Rendering Equation", SIGGRAPH 1986. A path starts at the
 * camera and goes on by chance. Light is found in two ways: the path hits it,
 * or a vertex asks for it (next event estimation); the profile says which
 * counts, and MIS weighs both so that each counts where it is good. */
#ifndef RAYBOOK_INTEGRATORS_PATH_H
#define RAYBOOK_INTEGRATORS_PATH_H

#include "integrators/tracer.h"

/* An estimate of the radiance that comes back along the ray, of paths with at
 * most max_depth scattering events: 1 is direct light only, 0 would be what
 * shines itself. */
rgb path_radiance(const struct tracer *t, ray r, struct ray_differential d);

/* The integrator `direct`: at most one scattering event that is not specular,
 * lights found by both ways. */
rgb direct_radiance(const struct tracer *t, ray r, struct ray_differential d);

#endif
