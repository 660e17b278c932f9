/* jpeg_check.h - is a JPEG file safe to hand to stb_image? */
#ifndef RAYBOOK_IMAGE_JPEG_CHECK_H
#define RAYBOOK_IMAGE_JPEG_CHECK_H

#include <stdbool.h>
#include <stdio.h>

#include "base/error.h"

/* stb_image 2.27, which Debian 12 has, trusts a JPEG file in four ways: it
 * writes past its tables for Huffman tables of more than 256 codes, decodes
 * by tables that the file never gave, takes a file that ends early for a
 * picture, and follows any number of scans. This walks the file's segments
 * (ITU-T T.81, annex B) and refuses all four, so that stb_image never sees
 * such a file; nor one of a size that image_size_is_fine refuses. file is read
 * from its beginning; path is for messages. false: *err is filled. */
bool jpeg_check(FILE *file, const char *path, struct error *err);

#endif
