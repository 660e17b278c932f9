/* read.h - image files as linear RGB. */
#ifndef RAYBOOK_IMAGE_READ_H
#define RAYBOOK_IMAGE_READ_H

#include <stdbool.h>

#include "base/error.h"
#include "image/image.h"

/* How 8-bit values are meant: auto takes 8-bit files (PNG, JPEG) as sRGB and
 * EXR and HDR as linear. */
enum image_encoding { ENCODING_AUTO, ENCODING_LINEAR, ENCODING_SRGB };

/* NULL-terminated, in the order of enum image_encoding. */
extern const char *const image_encoding_names[];

/* Reads an EXR, Radiance HDR, PNG or JPEG file (told by its first bytes, not
 * its name) into *out, which the caller owns: image_free. Row 0 is the top.
 * A grey image becomes three equal channels; alpha is dropped.
 *
 * false, with *err filled and *out empty: missing, a folder, not such an
 * image, truncated, larger than 2^26 pixels, a value that is NaN, infinite or
 * below zero, an EXR without R, G and B (or Y), deep or multi-part. */
bool image_read(const char *path, enum image_encoding encoding,
                struct image *out, struct error *err);

#endif
