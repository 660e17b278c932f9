/* bounce.h - one scattering event: the ray that goes on from a vertex. */
#ifndef RAYBOOK_INTEGRATORS_BOUNCE_H
#define RAYBOOK_INTEGRATORS_BOUNCE_H

#include "integrators/tracer.h"

/* Picks where the light came from and turns *r and *d into the ray that goes
 * there; *way says how it was picked. false: the light was absorbed. The
 * vertex must have a material. */
bool bounce(const struct tracer *t, const struct vertex *v, ray *r,
            struct ray_differential *d, struct scatter *way);

#endif
