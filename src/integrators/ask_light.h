/* ask_light.h - next event estimation: a vertex asks a light for its part.
 *
 * Here the pieces meet: the light picks a direction (light_sample), assignment
 * 05 says what comes of it (direct_light), and where the same light may also
 * be found by a scattered ray that hits it, each way gets its share. */
#ifndef RAYBOOK_INTEGRATORS_ASK_LIGHT_H
#define RAYBOOK_INTEGRATORS_ASK_LIGHT_H

#include "integrators/tracer.h"

/* A vertex that asks. weigh: scattered rays look for the lights as well, so
 * that asking gets its share only (mis.h). */
struct asking {
    const struct tracer *t;
    const struct vertex *v;
    bool weigh;
};

/* What this light alone (an index below the scene's light_count) adds to the
 * radiance that the vertex sends towards its `outgoing`: an estimate from one
 * direction to the light, with shadow. Each call takes fresh random numbers
 * from the sampler. Who asks this light instead of all of them has to divide
 * by the probability of that; here it has not been done. */
rgb ask_light(const struct asking *a, uint32_t light);

/* How likely the scene's integrator is to ask this light at a vertex: 1 where
 * it asks each of them, else as its table of lights says. */
float asking_probability(const struct scene *scene, uint32_t light);

#endif
