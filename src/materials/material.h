/* material.h - how a surface scatters light.
 *
 * All directions point away from the surface and have length one: `outgoing`
 * to where the light goes (the viewer), `incoming` to where it comes from. */
#ifndef RAYBOOK_MATERIALS_MATERIAL_H
#define RAYBOOK_MATERIALS_MATERIAL_H

#include <stdbool.h>

#include "base/rgb.h"
#include "shapes/surface.h"
#include "textures/texture.h"

enum material_kind { MATERIAL_DIFFUSE };

struct material {
    enum material_kind kind;
    const struct texture *albedo; /* owned by the scene */
    bool two_sided;
};

/* The part of incoming radiance that is scattered towards outgoing, per
 * steradian (the BSDF), without the cosine.
 *
 * A diffuse surface is albedo / pi where both directions lie on its normal's
 * side and black otherwise; two_sided turns the normal to the viewer first. */
rgb material_eval(const struct material *m, const struct surface *s,
                  vec3 outgoing, vec3 incoming);

/* The colour of the surface alone: what it reflects of white light from
 * everywhere. */
rgb material_albedo(const struct material *m, const struct surface *s);

#endif
