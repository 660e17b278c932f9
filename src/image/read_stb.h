/* read_stb.h - PNG and JPEG files, through stb_image. */
#ifndef RAYBOOK_IMAGE_READ_STB_H
#define RAYBOOK_IMAGE_READ_STB_H

#include <stdbool.h>
#include <stdio.h>

#include "base/error.h"
#include "image/image.h"

/* Reads the PNG or (jpeg true) JPEG file that file, at its beginning, holds.
 * srgb: its values are decoded by srgb_decode; otherwise they are linear. path
 * is for messages. false: *err is filled, *out not. */
bool stb_read(FILE *file, const char *path, bool jpeg, bool srgb,
              struct image *out, struct error *err);

#endif
