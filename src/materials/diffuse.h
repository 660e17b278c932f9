/* diffuse.h - the material `diffuse`: paper, plaster, chalk.
 *
 * The same radiance in all directions: albedo / pi (Lambert, 1760). It reflects
 * where outgoing and incoming are on the normal's side, by the geometric and
 * by the shading normal both, and is black otherwise: asking one normal only
 * would let light through at the rim of a smooth mesh, and asking more of one
 * direction than of the other would not be reciprocal. (Mitsuba asks the
 * shading normal only; on a closed mesh what it lets through below the
 * geometric surface is then blocked by the mesh itself, so that the images
 * agree.) two_sided does the same on the other side too. */
#ifndef RAYBOOK_MATERIALS_DIFFUSE_H
#define RAYBOOK_MATERIALS_DIFFUSE_H

#include "materials/material.h"

/* See material_eval, material_pdf. */
rgb diffuse_eval(const struct material *m, const struct surface *s,
                 vec3 outgoing, vec3 incoming);
float diffuse_pdf(const struct material *m, const struct surface *s,
                  vec3 outgoing, vec3 incoming);

/* See material_sample. In proportion to the cosine with the shading normal;
 * a pick below the geometric surface fails. */
bool diffuse_sample(const struct material *m, const struct surface *s,
                    vec3 outgoing, const float random[3], struct scatter *out);

#endif
