/* delta_lighting.h - the light of all lights without extent at a vertex. */
#ifndef RAYBOOK_INTEGRATORS_DELTA_LIGHTING_H
#define RAYBOOK_INTEGRATORS_DELTA_LIGHTING_H

#include "integrators/tracer.h"

/* The radiance (W m^-2 sr^-1) that the vertex sends along its `outgoing`
 * because the scene's point, directional and spot lights shine on it: the sum
 * over those that nothing hides. Lamps with an area and the environment are
 * left out.
 *
 * Any object hides a light, clear ones too. Black on a clear surface: it
 * scatters nothing. The vertex must have a material. */
rgb delta_lighting(const struct tracer *t, const struct vertex *v);

#endif
