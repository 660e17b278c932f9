/* read_limits.c - in place of src/image/read_limits.c while fuzzing: a header
 * of a few bytes can ask for 2^26 pixels, and the fuzzer would do little else
 * than zero them. */
#include "image/read_limits.h"

enum { FUZZ_MOST_PIXELS = 1 << 16 };

bool image_size_is_fine(const char *path, const char *what, int64_t width,
                        int64_t height, struct error *err)
{
    if (width >= 1 && height >= 1 && width <= FUZZ_MOST_PIXELS / height)
        return true;
    return error_set(err, "%s: %s: size", path, what);
}
