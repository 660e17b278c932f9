/* bounce.h - one scattering event: the ray that goes on from a vertex. */
#ifndef RAYBOOK_INTEGRATORS_BOUNCE_H
#define RAYBOOK_INTEGRATORS_BOUNCE_H

#include "integrators/tracer.h"

/* Picks where the light came from and turns *r and *d into the ray that goes
 * there. r and d are the ray that met the vertex, which must have a material;
 * the new ray starts just off the surface, on the side that it goes to.
 *
 * *way says how it was picked: what comes back along the new ray counts times
 * way->weight, a colour. false: the light was absorbed, and *r, *d and *way
 * hold nothing of use. Takes the sample's random numbers itself. */
bool bounce(const struct tracer *t, const struct vertex *v, ray *r,
            struct ray_differential *d, struct scatter *way);

#endif
