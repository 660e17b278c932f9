/* glass.h - the material `glass`: a smooth boundary that reflects part of the
 * light and refracts the rest.
 *
 * Fresnel's equations give the part that is reflected. R (reflectance) and T
 * (transmittance) tint the two parts; 1 is physical.
 *
 * Radiance is per solid angle, and refraction squeezes solid angles: on its way
 * across the boundary radiance changes by (index it comes to / index it comes
 * from)^2. So what comes through from outside is eta^2 times as bright inside,
 * and light that leaves a closed object has lost that factor again. Radiance
 * over index^2 is what stays the same: E. Veach, "Robust Monte Carlo Methods
 * for Light Transport Simulation", PhD thesis, Stanford, 1997, section 5.2. */
#ifndef RAYBOOK_MATERIALS_GLASS_H
#define RAYBOOK_MATERIALS_GLASS_H

#include "materials/material.h"

/* See material_sample. random[2] picks reflection with the Fresnel share as
 * its probability, which therefore cancels from the weight. */
bool glass_sample(const struct material *m, const struct surface *s,
                  vec3 outgoing, const float random[3], struct scatter *out);

#endif
