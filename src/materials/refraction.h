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
 * eta_inside_over_outside: the index of refraction inside divided by the one
 *   outside: 1.5 for glass in air, whichever side outgoing is on. Above 0.
 *
 * Snell's law: true is returned, and *incoming is the direction, of length one,
 * on the other side of the boundary. Total internal reflection: false is
 * returned, and *incoming is the mirror direction, on outgoing's own side.
 *
 * Accuracy asked for: 1e-6 in each component, plus what a wrong last digit of
 * the input can do; that is much near the critical angle, and at that angle
 * either answer is right. Straight on and grazing are angles like any other.
 *
 * Source: Pharr, Jakob, Humphreys, "Physically Based Rendering", 4th edition,
 * section 9.3. */
bool refraction_direction(vec3 normal, vec3 outgoing,
                          float eta_inside_over_outside, vec3 *incoming);

#endif
