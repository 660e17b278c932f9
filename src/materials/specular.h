/* specular.h - a mirror or a clear boundary on a surface with a smooth normal.
 *
 * The geometric normal has the last word on sides. The shading normal gives
 * the direction, so that a mesh with smooth normals looks curved; but at the
 * rim of a mesh that direction may point through the surface when it should
 * leave it, or the other way round. Wherever the two normals disagree about the
 * side of either direction, the geometric normal gives the direction instead.
 * So what is reflected stays on its side, what is refracted changes it, and
 * the ray that follows starts where it should.
 *
 * (Mitsuba asks the shading normal only, and lets such rays cross. They differ
 * at the rim: by 0.5 % of the mean of an image that a ball of 80 triangles
 * half fills, by less than 0.05 % with 320.) */
#ifndef RAYBOOK_MATERIALS_SPECULAR_H
#define RAYBOOK_MATERIALS_SPECULAR_H

#include <stdbool.h>

#include "shapes/surface.h"

/* The normal for Fresnel's equations: the shading normal, if the two agree
 * about outgoing. */
vec3 specular_normal(const struct surface *s, vec3 outgoing);

/* The mirror direction. */
vec3 specular_reflect(const struct surface *s, vec3 outgoing);

/* As refraction_direction: true, and the direction beyond the boundary; or,
 * on total internal reflection, false and the mirror direction. */
bool specular_refract(const struct surface *s, vec3 outgoing,
                      float eta_inside_over_outside, vec3 *incoming);

#endif
