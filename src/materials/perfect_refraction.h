/* perfect_refraction.h - the material `refraction`: a boundary that lets all
 * light through and bends it.
 *
 * Nothing is weighted: no Fresnel share is reflected, and radiance is not
 * scaled by the square of the index (glass.h does both). The weight is 1, so
 * that this material is a change of direction and nothing else. What a closed
 * object shows is the same either way: the factor on the way in cancels that
 * on the way out. Total internal reflection reflects, also with weight 1. */
#ifndef RAYBOOK_MATERIALS_PERFECT_REFRACTION_H
#define RAYBOOK_MATERIALS_PERFECT_REFRACTION_H

#include "materials/material.h"

/* See material_sample; uses no random number and never fails. */
bool perfect_refraction_sample(const struct material *m,
                               const struct surface *s, vec3 outgoing,
                               struct scatter *out);

#endif
