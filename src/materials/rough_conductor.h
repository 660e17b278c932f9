/* rough_conductor.h - the material `roughconductor`: unpolished metal.
 *
 * Torrance and Sparrow's model: the surface is made of tiny perfect mirrors,
 * whose normals are spread by the anisotropic GGX distribution D with
 * roughness alpha_x along u and alpha_y across it. The BSDF is
 *
 *     F D(h) G1(outgoing) G1(incoming) / (4 cos_outgoing cos_incoming)
 *
 * where h is halfway between the two directions, F the reflectance of the metal
 * (fresnel_conductor) and G1 Smith's share of mirrors that are not hidden from
 * a direction. Masking and shadowing are taken as independent, a product of
 * two, because Mitsuba's roughconductor does so; the height-correlated form is
 * a little brighter. Light that a mirror sends to another one is lost, so
 * rough metal is somewhat too dark.
 *
 * It is one-sided: black unless both directions are outside, by the geometric
 * and the shading normal both, as in diffuse.h.
 *
 * Source: B. Walter et al., "Microfacet Models for Refraction through Rough
 * Surfaces", EGSR 2007; E. Heitz, "Understanding the Masking-Shadowing
 * Function in Microfacet-Based BRDFs", JCGT 3(2), 2014. */
#ifndef RAYBOOK_MATERIALS_ROUGH_CONDUCTOR_H
#define RAYBOOK_MATERIALS_ROUGH_CONDUCTOR_H

#include "materials/material.h"

/* See material_eval, material_pdf. */
rgb rough_conductor_eval(const struct material *m, const struct surface *s,
                         vec3 outgoing, vec3 incoming);
float rough_conductor_pdf(const struct material *m, const struct surface *s,
                          vec3 outgoing, vec3 incoming);

/* See material_sample. A mirror is picked as often as it is seen from outgoing:
 * E. Heitz, "Sampling the GGX Distribution of Visible Normals", JCGT 7(4),
 * 2018. A pick that points below the surface fails; it is the light that the
 * model loses. */
bool rough_conductor_sample(const struct material *m, const struct surface *s,
                            vec3 outgoing, const float random[3],
                            struct scatter *out);

/* The metal's colour: the texture times the reflectance straight on. */
rgb rough_conductor_albedo(const struct material *m, const struct surface *s);

#endif
