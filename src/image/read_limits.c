/* read_limits.c - see read_limits.h. */
#include "image/read_limits.h"

#include <inttypes.h>

bool image_size_is_fine(const char *path, const char *what, int64_t width,
                        int64_t height, struct error *err)
{
    if (width >= 1 && height >= 1 && width <= IMAGE_MOST_PIXELS / height)
        return true;
    return error_set(err,
                     "%s: %s is %" PRId64 " x %" PRId64
                     " pixels, expected at least 1 x 1 and at most %d in all",
                     path, what, width, height, (int)IMAGE_MOST_PIXELS);
}
