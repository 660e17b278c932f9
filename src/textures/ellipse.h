/* ellipse.h - the patch of a texture that a pixel sees.
 *
 * What assignment 10 is given for its elliptically weighted average.
 *
 * Source: P. Heckbert, "Fundamentals of Texture Mapping and Image Warping",
 * master's thesis, UC Berkeley, 1989, section 3.5. */
#ifndef RAYBOOK_TEXTURES_ELLIPSE_H
#define RAYBOOK_TEXTURES_ELLIPSE_H

#include "textures/levels.h"

/* The points p around the centre with p' E^-1 p <= 1, in texels; E is the
 * symmetric matrix with rows xx xy and xy yy. Its eigenvalues are the squares
 * of the half axes. */
struct ellipse {
    double xx, xy, yy;
};

/* The circle around a pixel that reaches to its neighbours, mapped to the
 * texture: the points s uv_dx + t uv_dy with s^2 + t^2 <= 1, in texels of
 * level 0. All zero where both steps are (a step that is not finite counts as
 * none); without area where only one is, or both run the same way. */
struct ellipse ellipse_of_footprint(const struct mipmap *m, vec2 uv_dx,
                                    vec2 uv_dy);

/* Makes the ellipse wider where its longest axis is more than max_anisotropy
 * times its shortest: the longest stays, all others grow in proportion.
 * max_anisotropy counts as 1 or 64 where it is below or above. The ellipse is
 * not all zero. Returns the shortest half axis, in texels of level 0. */
double ellipse_widen(struct ellipse *e, float max_anisotropy);

/* Squeezes the ellipse along x or y where it reaches over so many repeats of
 * the image that more would not show: that bounds the work on images of a few
 * texels. */
void ellipse_limit_repeats(struct ellipse *e, const struct mipmap *m);

/* The ellipse in texels of a level, a little larger: bilinear interpolation
 * blurs the image, and to take the mean of texels instead of the interpolated
 * image this much must be added. Both half axes are longer than 0.86 texels,
 * so that the ellipse cannot fall between the texels. */
struct ellipse ellipse_on_level(const struct ellipse *e, const struct mipmap *m,
                                int level);

#endif
