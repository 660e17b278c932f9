/* mipmap.c - assignment 10: an image at every size, and which one to use.
 *
 * The contract is in mipmap.h. */
#include "textures/mipmap.h"

#include <stdint.h>

#include "base/minmax.h"
#include "base/todo.h"
#include "textures/color_sum.h"
#include "textures/ellipse.h"

//> mipmap.pyramid: Build the smaller levels
#ifndef TODO_mipmap_pyramid
//> mipmap.pyramid.overlap: Measure how much two texels overlap
/* A row of from texels and a row of to texels cover the same stretch. Let that
 * be from * to long: then a texel of the first row has the length to and one
 * of the second the length from, whole numbers all. This is how much two such
 * texels overlap. */
static int64_t overlap(int64_t from_index, int64_t from, int64_t to_index,
                       int64_t to)
{
    int64_t begin = from_index * to, end = begin + to;
    int64_t to_begin = to_index * from, to_end = to_begin + from;
    begin = begin > to_begin ? begin : to_begin;
    end = end < to_end ? end : to_end;
    return end - begin;
}

/* Those of a row of from texels that a texel of a row of to overlaps: first up
 * to, not including, end. Two when from is even, at most three when odd. */
struct span {
    int first, end;
};

static struct span overlapped(int index, int from, int to)
{
    struct span s;
    s.first = (int)((int64_t)index * from / to);
    s.end = (int)((((int64_t)index + 1) * from + to - 1) / to);
    return s;
}
//< mipmap.pyramid.overlap

//> mipmap.pyramid.mean: Take the mean of what a texel covers
/* The mean of what the texel at column x, row y of a smaller image covers. */
static rgb covered_mean(const struct image *from, const struct image *to, int x,
                        int y)
{
    struct color_sum sum = {0.0, 0.0, 0.0, 0.0};
    struct span columns = overlapped(x, from->width, to->width);
    struct span rows = overlapped(y, from->height, to->height);
    for (int j = rows.first; j < rows.end; j++)
        for (int i = columns.first; i < columns.end; i++) {
            double width = (double)overlap(i, from->width, x, to->width);
            double height = (double)overlap(j, from->height, y, to->height);
            size_t at = (size_t)j * (size_t)from->width + (size_t)i;
            color_sum_add(&sum, from->pixels[at], width * height);
        }
    return color_sum_mean(&sum);
}
//< mipmap.pyramid.mean

//> mipmap.pyramid.halve: Halve an image
static int half_size(int size)
{
    return size > 1 ? size / 2 : 1;
}

static struct image half_image(const struct image *from)
{
    struct image to =
        image_make(half_size(from->width), half_size(from->height));
    for (int y = 0; y < to.height; y++)
        for (int x = 0; x < to.width; x++)
            to.pixels[(size_t)y * (size_t)to.width + (size_t)x] =
                covered_mean(from, &to, x, y);
    return to;
}
//< mipmap.pyramid.halve
#endif

int mipmap_pyramid(struct image levels[MIPMAP_MAX_LEVELS])
{
#ifndef TODO_mipmap_pyramid
    int count = 1;
    const struct image *last = &levels[0];
    while (last->width > 1 || last->height > 1) {
        levels[count] = half_image(last);
        last = &levels[count++];
    }
    return count;
#else
    /* TODO(mipmap_pyramid): make levels[1], levels[2] and so on, each half the
     * size of the one before, until one is 1 x 1. Until then there is only the
     * image itself. */
    (void)levels;
    TODO_WARN("10 mipmap", "a pyramid of one level");
    return 1;
#endif
}
//< mipmap.pyramid

//> mipmap.level: Choose the level
#ifndef TODO_mipmap_level
/* The length in texels of level 0 of a step in texture coordinates. */
static double length_in_texels(const struct mipmap *m, vec2 step)
{
    vec2 d = mipmap_finite_step(step);
    return hypot((double)d.x * m->levels[0].width,
                 (double)d.y * m->levels[0].height);
}
#endif

float mipmap_level(const struct mipmap *m, vec2 uv_dx, vec2 uv_dy)
{
#ifndef TODO_mipmap_level
    double longer =
        fmax(length_in_texels(m, uv_dx), length_in_texels(m, uv_dy));
    return (float)fmin(log2(fmax(longer, 1.0)), m->level_count - 1);
#else
    /* TODO(mipmap_level): measure both sides of the footprint in texels of
     * level 0; log2 of the longer one is the level. Until then it is always
     * the image itself. */
    (void)m, (void)uv_dx, (void)uv_dy;
    TODO_WARN("10 mipmap", "the level is always 0");
    return 0.0f;
#endif
}
//< mipmap.level

//> mipmap.trilinear: Mix two levels
rgb mipmap_trilinear(const struct mipmap *m, vec2 uv, vec2 uv_dx, vec2 uv_dy)
{
#ifndef TODO_mipmap_trilinear
    float level = mipmap_level(m, uv_dx, uv_dy);
    int fine = (int)level;
    rgb color = mipmap_bilinear(m, fine, uv);
    if (fine == m->level_count - 1)
        return color;
    return rgb_mix(color, mipmap_bilinear(m, fine + 1, uv),
                   level - (float)fine);
#else
    /* TODO(mipmap_trilinear): look the colour up in the two levels around
     * mipmap_level, and mix. Until then distant textures flicker. */
    (void)uv_dx, (void)uv_dy;
    TODO_WARN("10 mipmap", "the nearest texel of the full image");
    return mipmap_nearest(m, 0, uv);
#endif
}
//< mipmap.trilinear

//> mipmap.ewa: Average over the footprint's ellipse
#ifndef TODO_mipmap_ewa
//> mipmap.ewa.weight: Weigh a texel by its distance
/* Beyond this squared distance from the centre (1: on the ellipse) the weight
 * is 0. */
static const double weight_end = 2.0;

/* A Gaussian, lowered so that it has no step at its end. */
static double ewa_weight(double distance2)
{
    const float lowest = 0.018315639f; /* exp(-2 weight_end) */
    return float_max(expf(-2.0f * (float)distance2) - lowest, 0.0f);
}
//< mipmap.ewa.weight

//> mipmap.ewa.row: Add up one row of an ellipse
/* One row of an ellipse:
 * p' E^-1 p = from_row + ((x - middle) / half_width)^2 */
struct ewa_row {
    double from_row, middle, half_width;
};

static void ewa_add_row(const struct mipmap *m, int level, int y,
                        const struct ewa_row *row, struct color_sum *sum)
{
    double reach = row->half_width * sqrt(weight_end - row->from_row);
    int last = (int)floor(row->middle + reach);
    for (int x = (int)ceil(row->middle - reach); x <= last; x++) {
        double across = (x - row->middle) / row->half_width;
        double weight = ewa_weight(row->from_row + across * across);
        color_sum_add(sum, mipmap_texel(m, level, x, y), weight);
    }
}
//< mipmap.ewa.row

//> mipmap.ewa.sum: Add up the ellipse row by row
/* The weighted mean of the texels of one level in the ellipse around uv. */
static rgb ewa_on_level(const struct mipmap *m, int level, vec2 uv,
                        const struct ellipse *footprint)
{
    struct ellipse e = ellipse_on_level(footprint, m, level);
    const struct image *image = &m->levels[level];
    double center_x = mipmap_in_texels(m, uv.x, image->width) - 0.5;
    double center_y = mipmap_in_texels(m, uv.y, image->height) - 0.5;
    double slope = e.xy / e.yy, reach = sqrt(weight_end * e.yy);
    struct ewa_row row = {0.0, 0.0, sqrt(e.xx - e.xy * slope)};
    struct color_sum sum = {0.0, 0.0, 0.0, 0.0};
    int last = (int)floor(center_y + reach);
    for (int y = (int)ceil(center_y - reach); y <= last; y++) {
        double down = y - center_y;
        row.from_row = fmin(down * down / e.yy, weight_end);
        row.middle = center_x + slope * down;
        ewa_add_row(m, level, y, &row, &sum);
    }
    return color_sum_mean(&sum);
}
//< mipmap.ewa.sum

//> mipmap.ewa.level: Choose the levels by the shorter axis
/* The shortest half axis is this many texels, or up to twice as many, of the
 * finer level used: so the box that made the level blurs less than the
 * ellipse. */
static const double fewest_texels = 1.5;

static float ewa_level(const struct mipmap *m, double shortest)
{
    double level = log2(fmax(shortest / fewest_texels, 1.0));
    return (float)fmin(level, m->level_count - 1);
}
//< mipmap.ewa.level
#endif

rgb mipmap_ewa(const struct mipmap *m, vec2 uv, vec2 uv_dx, vec2 uv_dy,
               float max_anisotropy)
{
#ifndef TODO_mipmap_ewa
    //> mipmap.ewa.blend: Average on two levels and mix
    struct ellipse e = ellipse_of_footprint(m, uv_dx, uv_dy);
    if (e.xx + e.yy == 0.0)
        return mipmap_bilinear(m, 0, uv);
    double shortest = ellipse_widen(&e, max_anisotropy);
    ellipse_limit_repeats(&e, m);
    float level = ewa_level(m, shortest);
    int fine = (int)level;
    rgb color = ewa_on_level(m, fine, uv, &e);
    if (fine == m->level_count - 1)
        return color;
    return rgb_mix(color, ewa_on_level(m, fine + 1, uv, &e),
                   level - (float)fine);
    //< mipmap.ewa.blend
#else
    /* TODO(mipmap_ewa): sum the texels in the footprint's ellipse, weighted by
     * a bell, on the levels that suit its shorter axis. Until then it is no
     * better than the nearest texel. */
    (void)uv_dx, (void)uv_dy, (void)max_anisotropy;
    TODO_WARN("10 mipmap", "the nearest texel of the full image");
    return mipmap_nearest(m, 0, uv);
#endif
}
//< mipmap.ewa
