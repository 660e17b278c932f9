/* delta_lights.h - lights without extent: one direction from each point.
 *
 * Each function answers light_sample for its kind. */
#ifndef RAYBOOK_LIGHTS_DELTA_LIGHTS_H
#define RAYBOOK_LIGHTS_DELTA_LIGHTS_H

#include "lights/light.h"

/* Irradiance by point_light.h. false at the light itself. */
bool point_light_sample(const struct light *light, vec3 point,
                        struct light_sample *out);

/* The same irradiance from the same direction everywhere. */
bool directional_light_sample(const struct light *light,
                              struct light_sample *out);

/* Irradiance intensity x falloff / d^2. false outside the cone. */
bool spot_light_sample(const struct light *light, vec3 point,
                       struct light_sample *out);

/* The share of the spot's full intensity in a direction whose cosine with the
 * axis is given: 1 within beam_angle, 0 beyond cutoff_angle, in between a
 * straight line in the angle. A hard edge where the two are equal. */
float spot_light_falloff(const struct light *light, float cosine);

#endif
