/* mipmap.h - assignment 10: an image at every size, and which one to use.
 *
 * Level 0 is the image, each further level half as wide and high (rounded
 * down, at least 1) down to 1 x 1. Any image size works: a texel of the next
 * level is the mean of exactly the area that it covers, so the mean of every
 * level is the mean of the image. */
#ifndef RAYBOOK_TEXTURES_MIPMAP_H
#define RAYBOOK_TEXTURES_MIPMAP_H

#include <stdbool.h>

#include "base/rgb.h"
#include "base/vec.h"
#include "image/image.h"

enum texture_wrap { WRAP_REPEAT, WRAP_CLAMP, WRAP_MIRROR, WRAP_BLACK };

/* NULL-terminated, in the order of enum texture_wrap. */
extern const char *const texture_wrap_names[];

enum { MIPMAP_MAX_LEVELS = 32 };

/* levels[0] is the image itself. The mipmap owns all levels. */
struct mipmap {
    struct image levels[MIPMAP_MAX_LEVELS];
    int level_count;
    enum texture_wrap wrap;
};

/* Takes the image over and builds the smaller levels; whole false: only level
 * 0. The image has at least one texel and at most 2^26 a side, and its values
 * are finite. Release with mipmap_free. */
struct mipmap mipmap_make(struct image image, enum texture_wrap wrap,
                          bool whole);

/* In all lookups a coordinate that is NaN or infinite counts as 0, and so does
 * a footprint's step. level is one that there is. */

/* The texel in column x, row y of a level, after the wrap; any x and y. */
rgb mipmap_texel(const struct mipmap *m, int level, int x, int y);

/* The texel that uv falls into. */
rgb mipmap_nearest(const struct mipmap *m, int level, vec2 uv);

/* The four texels around uv, weighted by nearness. */
rgb mipmap_bilinear(const struct mipmap *m, int level, vec2 uv);

/* The level whose texels are as large as the longer side of the footprint:
 * log2 of that length in texels of level 0, clamped to the levels there are.
 * A footprint of zero gives 0. */
float mipmap_level(const struct mipmap *m, vec2 uv_dx, vec2 uv_dy);

/* Between the two levels around mipmap_level, each bilinear. */
rgb mipmap_trilinear(const struct mipmap *m, vec2 uv, vec2 uv_dx, vec2 uv_dy);

/* Elliptically weighted average: the mean over the points uv + s uv_dx +
 * t uv_dy weighted by a Gaussian, exp(-2 q) - exp(-4) where q = s^2 + t^2 is
 * below 2, summed over texels. The ellipse q = 1 is made wider when its longest
 * axis is more than max_anisotropy (1 .. 64) times its shortest. The sum is
 * taken on the two levels around that on which the shortest half axis is 1.5
 * texels, and blended; an ellipse narrower than that uses level 0, and none at
 * all (both steps zero) is a bilinear lookup. The mipmap must be whole: then a
 * lookup reads at most some hundred texels for each unit of max_anisotropy.
 *
 * Source: N. Greene and P. Heckbert, "Creating Raster Omnimax Images from
 * Multiple Perspective Views Using the Elliptical Weighted Average Filter",
 * IEEE CG&A 6(6), 1986; P. Heckbert, "Fundamentals of Texture Mapping and Image
 * Warping", master's thesis, UC Berkeley, 1989, section 3.5. */
rgb mipmap_ewa(const struct mipmap *m, vec2 uv, vec2 uv_dx, vec2 uv_dy,
               float max_anisotropy);

void mipmap_free(struct mipmap *m);

#endif
