/* ggx.h - a surface made of tiny mirrors: how they lie, which are seen.
 *
 * Directions and normals have length one and are in the shading frame: z is
 * up, x along the texture's u; those that "see" the surface have z > 0.
 * alpha, above 0: the roughness along x and y: a slope of alpha is a quarter
 * as frequent as none.
 *
 * Source: E. Heitz, "Understanding the Masking-Shadowing Function in
 * Microfacet-Based BRDFs", JCGT 3(2), 2014, appendix A; "Sampling the GGX
 * Distribution of Visible Normals", JCGT 7(4), 2018. */
#ifndef RAYBOOK_MATERIALS_GGX_H
#define RAYBOOK_MATERIALS_GGX_H

#include "base/vec.h"

/* D: the area of the mirrors with normals around `normal`, per steradian and
 * per area of the surface. */
float ggx_density(vec2 alpha, vec3 normal);

/* G1 / cosine: the share of the mirrors turned to `direction` that are seen
 * from there and not behind others, over direction.z. Finite down to grazing,
 * which the quotient of the two is not. */
float ggx_seen_over_cosine(vec2 alpha, vec3 direction);

/* Picks a mirror's normal among those seen from `direction`, each as often as
 * it fills the view: with the density D G1 (direction . normal) / direction.z.
 * random: two numbers in [0, 1). */
vec3 ggx_sample_seen(vec2 alpha, vec3 direction, vec2 random);

#endif
