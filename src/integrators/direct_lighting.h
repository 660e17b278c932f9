/* direct_lighting.h - assignment 05: the light that arrives without detours. */
#ifndef RAYBOOK_INTEGRATORS_DIRECT_LIGHTING_H
#define RAYBOOK_INTEGRATORS_DIRECT_LIGHTING_H

#include "integrators/tracer.h"

/* The radiance that the vertex sends towards its `outgoing` because of one
 * picked direction to a light: BSDF x arriving radiance x cosine / pdf, and
 * nothing where the light is hidden.
 *
 * weigh: the light may also be found by a scattered ray that hits it, so this
 * way of finding it gets its share only: the power heuristic of E. Veach,
 * "Robust Monte Carlo Methods for Light Transport Simulation", 1997, section
 * 9.2.4. pick_probability: how likely this light was to be asked. */
rgb direct_light(const struct tracer *t, const struct vertex *v,
                 const struct light *light, float pick_probability, bool weigh);

/* The same for the scene's lights: all of them, or one that stands for all. */
rgb direct_lighting(const struct tracer *t, const struct vertex *v, bool weigh);

/* How likely direct_lighting would have picked this direction to this light:
 * probability of the light times density of the direction, per steradian. */
float direct_lighting_pdf(const struct scene *scene, uint32_t light, vec3 point,
                          vec3 direction, vec3 position, vec3 normal);

/* pdf^2 / (pdf^2 + other^2) */
float power_heuristic(float pdf, float other);

#endif
