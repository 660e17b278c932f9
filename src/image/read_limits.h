/* read_limits.h - what every image reader refuses. */
#ifndef RAYBOOK_IMAGE_READ_LIMITS_H
#define RAYBOOK_IMAGE_READ_LIMITS_H

#include <stdbool.h>
#include <stdint.h>

#include "base/error.h"

enum { IMAGE_MOST_PIXELS = 1 << 26 }; /* 8192 x 8192; 805 MB of floats */

/* Is it an image of at least one pixel and not more than the limit? Otherwise
 * *err is filled. what names the size, such as "the PNG file". */
bool image_size_is_fine(const char *path, const char *what, int64_t width,
                        int64_t height, struct error *err);

#endif
