/* read_hdr.h - Radiance HDR files (RGBE). */
#ifndef RAYBOOK_IMAGE_READ_HDR_H
#define RAYBOOK_IMAGE_READ_HDR_H

#include <stdbool.h>
#include <stdio.h>

#include "base/error.h"
#include "image/image.h"

/* Reads a Radiance picture of the format 32-bit_rle_rgbe, rows from the top
 * ("-Y height +X width"), flat or run-length encoded. The header's EXPOSURE
 * and PRIMARIES are not applied, as in most programs. file is at its
 * beginning; path is for messages. false: *err is filled, *out not.
 *
 * Not through stb_image: 2.27, which Debian 12 has, never returns from a run
 * of length 0, nor from a file that ends inside a row.
 *
 * Source: G. Ward, "Real Pixels", Graphics Gems II, 1991, and the format's
 * description in Radiance's own file filefmts.pdf. */
bool hdr_read(FILE *file, const char *path, struct image *out,
              struct error *err);

#endif
