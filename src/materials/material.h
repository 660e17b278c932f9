/* material.h - how a surface scatters light.
 *
 * All directions point away from the surface and have length one: `outgoing`
 * to where the light goes (the viewer), `incoming` to where it comes from.
 * Densities are per steradian of `incoming`. */
#ifndef RAYBOOK_MATERIALS_MATERIAL_H
#define RAYBOOK_MATERIALS_MATERIAL_H

#include <stdbool.h>

#include "base/rgb.h"
#include "shapes/surface.h"
#include "textures/texture.h"

enum material_kind {
    MATERIAL_DIFFUSE,
    MATERIAL_REFRACTION,
    MATERIAL_GLASS,
    MATERIAL_ROUGH_CONDUCTOR
};

/* Textures are owned by the scene. */
struct material {
    enum material_kind kind;
    const struct texture *albedo;   /* diffuse; factor of the rough conductor */
    bool two_sided;                 /* diffuse */
    float eta;                      /* refraction, glass: inside over outside */
    rgb reflectance, transmittance; /* glass: factors of the two parts */
    float alpha_x, alpha_y;         /* rough conductor: GGX roughness */
    rgb conductor_eta, conductor_k; /* complex index, relative to outside */
};

/* One direction that light may have come from. */
struct scatter {
    vec3 incoming;
    rgb weight; /* BSDF x |cosine| / pdf */
    float pdf;  /* 0 for a specular one: a single direction, not a density */
    bool specular;
    bool transmitted; /* incoming is on the other side */
};

/* Is light scattered into single directions only? Then eval and pdf are 0. */
bool material_is_specular(const struct material *m);

/* The part of incoming radiance that is scattered towards outgoing, per
 * steradian (the BSDF), without the cosine.
 *
 * A diffuse surface is albedo / pi where both directions lie on its normal's
 * side and black otherwise; two_sided turns the normal to the viewer first. */
rgb material_eval(const struct material *m, const struct surface *s,
                  vec3 outgoing, vec3 incoming);

/* Picks an incoming direction. random: three numbers in [0, 1). false: the
 * light is absorbed (or the pick failed: its share counts as black). */
bool material_sample(const struct material *m, const struct surface *s,
                     vec3 outgoing, const float random[3], struct scatter *out);

/* The density with which material_sample picks incoming. */
float material_pdf(const struct material *m, const struct surface *s,
                   vec3 outgoing, vec3 incoming);

/* The colour of the surface alone: what it reflects of white light from
 * everywhere; 1 for clear materials. For the albedo view and the stubs. */
rgb material_albedo(const struct material *m, const struct surface *s);

#endif
