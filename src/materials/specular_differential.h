/* specular_differential.h - what a mirror or a lens does to a pixel's width.
 *
 * The rays of neighbouring pixels meet the surface elsewhere and with another
 * normal; after the bounce they spread more or less than before. Knowing by
 * how much, a texture seen through glass can be filtered as well as one that
 * is seen directly. */
#ifndef RAYBOOK_MATERIALS_SPECULAR_DIFFERENTIAL_H
#define RAYBOOK_MATERIALS_SPECULAR_DIFFERENTIAL_H

#include "base/ray.h"
#include "base/ray_differential.h"
#include "materials/material.h"

/* The differential of the ray that goes on along way->incoming after r, with
 * the differential in, met the surface. r->direction has length one; way comes
 * from material_sample of this material, which is specular. out may be in.
 *
 * Exact to first order for the shading normal and its derivatives, the
 * surface taken as its tangent plane. A change that is not finite (a glancing
 * ray, a differential that overflowed) becomes zero.
 *
 * Source: H. Igehy, "Tracing Ray Differentials", SIGGRAPH 1999, sections 3.1
 * (transfer), 3.2 (reflection) and 3.3 (refraction). */
void material_specular_differential(const struct material *m,
                                    const struct surface *s, const ray *r,
                                    const struct ray_differential *in,
                                    const struct scatter *way,
                                    struct ray_differential *out);

#endif
