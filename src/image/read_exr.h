/* read_exr.h - OpenEXR files, through OpenEXRCore's C interface. */
#ifndef RAYBOOK_IMAGE_READ_EXR_H
#define RAYBOOK_IMAGE_READ_EXR_H

#include <stdbool.h>

#include "base/error.h"
#include "image/image.h"

/* Reads the display window of a single-part scanline or tiled file (of several
 * levels the largest), channels R, G and B, or Y, each half, float or uint,
 * any compression. Pixels outside the data window are black. false: *err is
 * filled, *out not. */
bool exr_read(const char *path, struct image *out, struct error *err);

#endif
