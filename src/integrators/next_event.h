/* next_event.h - the scene's lights, asked at a vertex of a path. */
#ifndef RAYBOOK_INTEGRATORS_NEXT_EVENT_H
#define RAYBOOK_INTEGRATORS_NEXT_EVENT_H

#include "integrators/tracer.h"

/* The radiance that the vertex sends towards its `outgoing` because of the
 * scene's lights: all of them, or one that stands for all. weigh: only the
 * share of it that is left beside scattered rays that hit the lights. */
rgb next_event(const struct tracer *t, const struct vertex *v, bool weigh);

/* How likely next_event would have picked this direction to this light:
 * probability of the light times density of the direction, per steradian.
 * See light_pdf. */
float next_event_pdf(const struct scene *scene, uint32_t light, vec3 point,
                     vec3 direction, vec3 position, vec3 normal);

#endif
