/* srgb.h - the curve between 8-bit codes and light. */
#ifndef RAYBOOK_IMAGE_SRGB_H
#define RAYBOOK_IMAGE_SRGB_H

/* The linear value, 0 .. 1, of a code given as a fraction, 0 .. 1, of the
 * largest one: IEC 61966-2-1, section 5.2, the inverse of srgb_encode. */
float srgb_decode(float code);

#endif
