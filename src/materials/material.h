/* material.h - how a surface scatters light.
 *
 * All directions point away from the surface and have length one: `outgoing`
 * to where the light goes (the viewer), `incoming` to where it comes from.
 * Densities are per steradian of `incoming`. A surface's outside is where its
 * normals point.
 *
 * Each material says in its own header what it does: diffuse.h,
 * perfect_refraction.h, glass.h, rough_conductor.h; sides.h and specular.h say
 * what becomes of a smooth mesh where its two normals disagree. */
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
    float alpha_x, alpha_y;         /* rough conductor: GGX, 0.001 to 1 */
    rgb conductor_eta, conductor_k; /* complex index, relative to outside */
};

/* One direction that light may have come from. */
struct scatter {
    vec3 incoming;
    rgb weight; /* BSDF x |cosine with the shading normal| / pdf */
    float pdf;  /* 0 for a specular one: a single direction, not a density */
    bool specular;
    bool transmitted; /* incoming is on the other side */
};

/* Is light scattered into single directions only? Then eval and pdf are 0. */
bool material_is_specular(const struct material *m);

/* The part of incoming radiance that is scattered towards outgoing, per
 * steradian (the BSDF), without the cosine. Diffuse and rough conductor are
 * black unless both directions are outside; a two_sided diffuse surface also
 * reflects where both are inside. */
rgb material_eval(const struct material *m, const struct surface *s,
                  vec3 outgoing, vec3 incoming);

/* Picks an incoming direction. random: three numbers in [0, 1), of which the
 * first two, a pair, pick a direction and the third one of several parts.
 * false: the light is absorbed, or the pick failed: its share counts as black,
 * and *out is not to be used. */
bool material_sample(const struct material *m, const struct surface *s,
                     vec3 outgoing, const float random[3], struct scatter *out);

/* The density with which material_sample picks incoming. Over all directions
 * it adds up to one less the share of picks that fail. */
float material_pdf(const struct material *m, const struct surface *s,
                   vec3 outgoing, vec3 incoming);

/* The colour of the surface alone: the texture; of metal, the texture times
 * the reflectance straight on; 1 for clear materials. For the albedo view and
 * the stubs. */
rgb material_albedo(const struct material *m, const struct surface *s);

#endif
