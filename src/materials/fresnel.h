/* fresnel.h - how much of the light a smooth boundary reflects.
 *
 * The share of the power of unpolarised light, 0 to 1; the rest passes on
 * (dielectric) or is absorbed (conductor). cosine, 0 to 1, is that of the angle
 * between the light and the normal; 0 gives 1: light that grazes is all
 * reflected.
 *
 * Source: M. Born and E. Wolf, "Principles of Optics", 7th edition, sections
 * 1.5.2 (dielectrics) and 14.2 (metals). */
#ifndef RAYBOOK_MATERIALS_FRESNEL_H
#define RAYBOOK_MATERIALS_FRESNEL_H

/* eta_beyond_over_here: the index of refraction on the far side over the one
 * on the side where the light is, above 0. 1 is returned from the critical
 * angle on. */
float fresnel_dielectric(float cosine, float eta_beyond_over_here);

/* eta + i k: the metal's complex index over the index outside; eta, k >= 0. */
float fresnel_conductor(float cosine, float eta, float k);

#endif
