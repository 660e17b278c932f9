/* refraction.h - assignment 04: light through a clear boundary.
 *
 * All directions have length one and point away from the surface. */
#ifndef RAYBOOK_MATERIALS_REFRACTION_H
#define RAYBOOK_MATERIALS_REFRACTION_H

#include <stdbool.h>

#include "base/vec.h"

/* Where the light that leaves along `outgoing` came from, through a perfectly
 * smooth boundary.
 *
 * normal: of length one; it points to the outside of the object, and so
 *   decides whether outgoing is outside (dot >= 0) or in.
 * outgoing: of length one, on either side.
 * eta_inside_over_outside: the index of refraction inside divided by the one
 *   outside: 1.5 for glass in air, whichever side outgoing is on. 0.1 to 10.
 * incoming: always written.
 *
 * Snell's law: true is returned, and *incoming is the direction, of length one,
 * on the other side of the boundary. Total internal reflection: false is
 * returned, and *incoming is the mirror direction, on outgoing's own side.
 *
 * Accuracy asked for: with ratio the index on outgoing's side over the one
 * beyond, 1e-6 (1 + ratio) in each component, plus what an error of
 * 1e-6 (1 + ratio^2) in the squared cosine beyond the boundary does to it. So
 * single precision will do. That is much near the critical angle only, and
 * where such an error decides between the two answers either is right.
 * Straight on and grazing are angles like any other.
 *
 * Not asked: what share of the light passes, input that is not finite.
 *
 * Source: Pharr, Jakob, Humphreys, "Physically Based Rendering", 4th edition,
 * section 9.3. */
bool refraction_direction(vec3 normal, vec3 outgoing,
                          float eta_inside_over_outside, vec3 *incoming);

#endif
