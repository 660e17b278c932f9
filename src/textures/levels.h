/* levels.h - the levels of a mipmap, and lookups in one of them.
 *
 * What assignment 10 is given: mipmap.h builds on it. */
#ifndef RAYBOOK_TEXTURES_LEVELS_H
#define RAYBOOK_TEXTURES_LEVELS_H

#include <stdbool.h>

#include "base/rgb.h"
#include "base/vec.h"
#include "image/image.h"

/* What lies beside the image: itself again, its border's texels, its mirror
 * image, or black. */
enum texture_wrap { WRAP_REPEAT, WRAP_CLAMP, WRAP_MIRROR, WRAP_BLACK };

/* NULL-terminated, in the order of enum texture_wrap. */
extern const char *const texture_wrap_names[];

enum { MIPMAP_MAX_LEVELS = 32 };

/* levels[0] is the image itself; there are level_count of them, at least 1.
 * The mipmap owns all levels. */
struct mipmap {
    struct image levels[MIPMAP_MAX_LEVELS];
    int level_count;
    enum texture_wrap wrap;
};

/* Takes the image over and builds the smaller levels (mipmap_pyramid); whole
 * false: only level 0. The image has at least one texel and at most 2^26 a
 * side, and its values are finite. Release with mipmap_free. */
struct mipmap mipmap_make(struct image image, enum texture_wrap wrap,
                          bool whole);

void mipmap_free(struct mipmap *m);

/* ---- lookups in one level; level is one that there is ----
 *
 * uv (0, 0) is the image's upper left corner and (1, 1) its lower right one,
 * whatever the level's size: so texel x of a level `width` texels wide reaches
 * from u = x / width to (x + 1) / width. A coordinate that is NaN or infinite
 * counts as 0. */

/* The texel in column x, row y, after the wrap; any x and y. */
rgb mipmap_texel(const struct mipmap *m, int level, int x, int y);

/* The texel that uv falls into. */
rgb mipmap_nearest(const struct mipmap *m, int level, vec2 uv);

/* The four texels around uv, weighted by nearness: exactly a texel's colour
 * in its middle. */
rgb mipmap_bilinear(const struct mipmap *m, int level, vec2 uv);

/* A texture coordinate in texels of a level that has size texels along it.
 * Repeating wraps have been brought near the image and the others stop far
 * from it: so it may be turned into an int, and the texel is the same. */
double mipmap_in_texels(const struct mipmap *m, float u, int size);

/* A footprint's step; (0, 0), no step, where one of its components is not a
 * finite number. */
vec2 mipmap_finite_step(vec2 step);

#endif
