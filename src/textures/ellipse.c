/* ellipse.c - see ellipse.h. */
#include "textures/ellipse.h"

#include "base/minmax.h"

//> ellipse.footprint: The ellipse of a footprint
struct ellipse ellipse_of_footprint(const struct mipmap *m, vec2 uv_dx,
                                    vec2 uv_dy)
{
    const struct image *image = &m->levels[0];
    vec2 dx = mipmap_finite_step(uv_dx), dy = mipmap_finite_step(uv_dy);
    double ax = (double)dx.x * image->width, ay = (double)dx.y * image->height;
    double bx = (double)dy.x * image->width, by = (double)dy.y * image->height;
    struct ellipse e = {ax * ax + bx * bx, ax * ay + bx * by,
                        ay * ay + by * by};
    return e;
}
//< ellipse.footprint

//> ellipse.widen: Make a needle wider
static const float most_anisotropy = 64.0f;

/* The squares of the half axes are mean + spread and mean - spread; a matrix
 * keep E + add I has the axes of E and the squares keep * square + add. */
double ellipse_widen(struct ellipse *e, float max_anisotropy)
{
    double ratio = float_min(float_max(max_anisotropy, 1.0f), most_anisotropy);
    double mean = 0.5 * (e->xx + e->yy);
    double spread = hypot(0.5 * (e->xx - e->yy), e->xy);
    double longest = mean + spread, shortest = mean - spread;
    double wanted = longest / (ratio * ratio);
    if (shortest >= wanted)
        return sqrt(shortest);
    double keep = (longest - wanted) / (longest - shortest);
    double add = wanted - keep * shortest;
    e->xx = keep * e->xx + add;
    e->xy = keep * e->xy;
    e->yy = keep * e->yy + add;
    return sqrt(wanted);
}
//< ellipse.widen

void ellipse_limit_repeats(struct ellipse *e, const struct mipmap *m)
{
    const double repeats = 4.0;
    double x = fmin(1.0, repeats * m->levels[0].width / sqrt(e->xx));
    double y = fmin(1.0, repeats * m->levels[0].height / sqrt(e->yy));
    e->xx *= x * x;
    e->xy *= x * y;
    e->yy *= y * y;
}

//> ellipse.level: The ellipse on another level
/* Interpolation blurs with a variance of 1/6 along each axis, and the weights
 * of mipmap_ewa have one of 0.21 when the ellipse is the unit circle: so the
 * sum of texels that comes nearest to the integral over the interpolated image
 * adds about 3/4 to the squares of both axes. (Heckbert, whose texels are
 * little Gaussians, adds 1.) */
struct ellipse ellipse_on_level(const struct ellipse *e, const struct mipmap *m,
                                int level)
{
    const double texel = 0.75;
    const struct image *image = &m->levels[level];
    double x = (double)image->width / m->levels[0].width;
    double y = (double)image->height / m->levels[0].height;
    struct ellipse on_level = {e->xx * x * x + texel, e->xy * x * y,
                               e->yy * y * y + texel};
    return on_level;
}
//< ellipse.level
