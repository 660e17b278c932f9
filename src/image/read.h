/* read.h - image files as linear RGB. */
#ifndef RAYBOOK_IMAGE_READ_H
#define RAYBOOK_IMAGE_READ_H

#include <stdbool.h>

#include "base/error.h"
#include "image/image.h"

/* How the values of a PNG or JPEG file are meant: auto takes them as sRGB.
 * EXR and HDR files are linear; to ask for sRGB there is an error. */
enum image_encoding { ENCODING_AUTO, ENCODING_LINEAR, ENCODING_SRGB };

/* NULL-terminated, in the order of enum image_encoding. */
extern const char *const image_encoding_names[];

/* Reads an EXR, Radiance HDR, PNG or JPEG file (told by its first bytes, not
 * its name) into *out, which the caller owns: image_free. Row 0 is the top.
 * A grey image becomes three equal channels; alpha is dropped; 16-bit PNG
 * files keep their 16 bits. An EXR file's image is its display window: black
 * where the data window does not reach, cut off where it reaches further.
 *
 * false, with *err filled and *out empty: missing, a folder, not such an
 * image, truncated or damaged, larger than 2^26 pixels, a value that is
 * NaN, infinite or below zero, an EXR without R, G and B (or Y), with
 * subsampled channels, deep or multi-part. Hostile files do no harm. */
bool image_read(const char *path, enum image_encoding encoding,
                struct image *out, struct error *err);

#endif
