/* mipmap.h - assignment 10: an image at every size, and which one to use.
 *
 * A pixel that sees a thousand texels wants their mean. A mipmap has the means
 * ready: level 0 is the image, each further level is half as wide and high,
 * the last is 1 x 1. What is given for this is in levels.h (texels, the wrap,
 * a lookup in one level), color_sum.h and ellipse.h.
 *
 * How many texels a pixel sees is its footprint: uv_dx and uv_dy say how far
 * the texture coordinates of its neighbours to the right and below are. All of
 * these may be any floats, however large. A step that is NaN or infinite counts
 * as none, (0, 0), and so does a coordinate uv as 0. What levels.h and
 * ellipse.h give takes care of both. */
#ifndef RAYBOOK_TEXTURES_MIPMAP_H
#define RAYBOOK_TEXTURES_MIPMAP_H

#include "textures/levels.h"

/* Builds the pyramid: fills levels[1], levels[2], ... and returns how many
 * levels there are, levels[0] included.
 *
 * levels[0] is the image and stays as it is, 1 to 2^26 texels a side, of any
 * size, with finite values. Each level is half as wide and half as high as the
 * one before, rounded down, but at least 1; the last, and only the last, is
 * 1 x 1. An image of 1 x 1 is a pyramid by itself. New levels are made by
 * image_make and then belong to the caller.
 *
 * A texel is the mean of exactly the area that it covers, of the level before
 * or of the image (both are right), to 1e-4 of the largest texel. From 5
 * texels in a row to 2, each covers two and a half: the one in the middle
 * counts half for either. So the mean of every level is the image's. */
int mipmap_pyramid(struct image levels[MIPMAP_MAX_LEVELS]);

/* The level whose texels are as large as the longer side of the footprint:
 * log2 of that length in texels of level 0, from 0 up to the last level that
 * there is; within 0.01. The sides are uv_dx and uv_dy; a whole u is as many
 * texels as the image is wide, a whole v as many as it is high. A footprint
 * of zero gives 0. */
float mipmap_level(const struct mipmap *m, vec2 uv_dx, vec2 uv_dy);

/* A mix of the two levels around mipmap_level, each looked up bilinearly: at
 * level 2.25 three parts of level 2 and one of level 3. Within 0.01 of the
 * largest texel. Nothing but the levels of *m is read: they need not be the
 * means of each other. */
rgb mipmap_trilinear(const struct mipmap *m, vec2 uv, vec2 uv_dx, vec2 uv_dy);

/* Elliptically weighted average: the mean of the image around uv, weighted by
 * a bell over the ellipse of the footprint. A point uv + s uv_dx + t uv_dy
 * weighs exp(-2 q) with q = s^2 + t^2, as far as q = 2 or so: the bell may end
 * anywhere from q = 1 to q = 4, with a step or lowered to 0. The weights are
 * divided by their sum.
 *
 * - Where the longest axis is more than max_anisotropy (1 to 64) times the
 *   shortest, the ellipse is made wider: the longest stays.
 * - The sum is taken over texels of levels on which the shortest half axis is
 *   about 1 to 3 texels, and blended between two such levels.
 * - An ellipse narrower than that is summed on level 0; it is widened by up to
 *   a texel there, so that it does not fall between the texels. No ellipse,
 *   both steps zero, is a bilinear lookup of level 0.
 * - A lookup reads at most some hundred texels for each unit of
 *   max_anisotropy, however small the image and large the footprint: an
 *   ellipse that spans several repeats of the image may be shrunk to them.
 *
 * The mipmap has all its levels; here they are means of each other.
 *
 * Source: N. Greene and P. Heckbert, "Creating Raster Omnimax Images from
 * Multiple Perspective Views Using the Elliptical Weighted Average Filter",
 * IEEE CG&A 6(6), 1986; P. Heckbert, "Fundamentals of Texture Mapping and Image
 * Warping", master's thesis, UC Berkeley, 1989, section 3.5. */
rgb mipmap_ewa(const struct mipmap *m, vec2 uv, vec2 uv_dx, vec2 uv_dy,
               float max_anisotropy);

#endif
