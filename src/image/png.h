/* png.h - pictures for people: 8 bits, tone-mapped. */
#ifndef RAYBOOK_IMAGE_PNG_H
#define RAYBOOK_IMAGE_PNG_H

#include <stdbool.h>
#include <stdint.h>

#include "base/error.h"
#include "image/image.h"

/* Linear value to an 8-bit code: clipped to [0, 1] (NaN is black), then the
 * sRGB curve of IEC 61966-2-1, section 5.2. A value of 1 is white: the preview
 * does not choose an exposure, so a picture too bright looks too bright. */
uint8_t srgb_encode(float linear);

/* Writes the image through srgb_encode. The file is complete or absent.
 * false: *err says why. */
bool png_write(const char *path, const struct image *image, struct error *err);

#endif
