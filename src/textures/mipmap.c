/* mipmap.c - assignment 10: an image at every size, and which one to use.
 *
 * The contract is in mipmap.h. */
#include "textures/mipmap.h"

#include <stdint.h>

const char *const texture_wrap_names[] = {"repeat", "clamp", "mirror", "black",
                                          NULL};

/* ---- means ---- */

/* A sum of weighted colours, in double so that a mean keeps its digits. */
struct color_sum {
    double r, g, b, weight;
};

static void sum_add(struct color_sum *sum, rgb color, double weight)
{
    sum->r += weight * color.r;
    sum->g += weight * color.g;
    sum->b += weight * color.b;
    sum->weight += weight;
}

static rgb sum_mean(const struct color_sum *sum)
{
    double k = 1.0 / sum->weight;
    return rgb_make((float)(sum->r * k), (float)(sum->g * k),
                    (float)(sum->b * k));
}

/* a for t = 0, b for t = 1; exactly a where the two are equal. */
static rgb rgb_mix(rgb a, rgb b, float t)
{
    return rgb_make(a.r + t * (b.r - a.r), a.g + t * (b.g - a.g),
                    a.b + t * (b.b - a.b));
}

/* ---- the pyramid ---- */

static int half_size(int size)
{
    return size > 1 ? size / 2 : 1;
}

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
            sum_add(&sum,
                    from->pixels[(size_t)j * (size_t)from->width + (size_t)i],
                    width * height);
        }
    return sum_mean(&sum);
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

struct mipmap mipmap_make(struct image image, enum texture_wrap wrap,
                          bool whole)
{
    struct mipmap m = {{image}, 1, wrap};
    const struct image *last = &m.levels[0];
    while (whole && (last->width > 1 || last->height > 1)) {
        m.levels[m.level_count] = half_image(last);
        last = &m.levels[m.level_count++];
    }
    return m;
}

void mipmap_free(struct mipmap *m)
{
    for (int i = 0; i < m->level_count; i++)
        image_free(&m->levels[i]);
    m->level_count = 0;
}

/* ---- texels ---- */

/* The remainder that lies in 0 .. n - 1, also of a negative i. */
static int floor_mod(int i, int n)
{
    int remainder = i % n;
    return remainder < 0 ? remainder + n : remainder;
}

/* Which of size texels the wrap puts at index i; -1: none. */
static int wrap_index(enum texture_wrap wrap, int i, int size)
{
    if (i >= 0 && i < size)
        return i;
    int there_and_back = floor_mod(i, 2 * size);
    switch (wrap) {
    case WRAP_REPEAT:
        return floor_mod(i, size);
    case WRAP_CLAMP:
        return i < 0 ? 0 : size - 1;
    case WRAP_MIRROR:
        return there_and_back < size ? there_and_back
                                     : 2 * size - 1 - there_and_back;
    default:
        return -1;
    }
}

rgb mipmap_texel(const struct mipmap *m, int level, int x, int y)
{
    const struct image *image = &m->levels[level];
    int column = wrap_index(m->wrap, x, image->width);
    int row = wrap_index(m->wrap, y, image->height);
    if (column < 0 || row < 0)
        return rgb_grey(0.0f);
    return image->pixels[(size_t)row * (size_t)image->width + (size_t)column];
}

/* ---- lookups of one level ---- */

/* A texture coordinate in texels. The wraps that have a period are brought
 * near 0 and the others stop far outside the image, so that the result fits
 * an int with room to spare; a coordinate that is not finite counts as 0. */
static double in_texels(const struct mipmap *m, float u, int size)
{
    double x = isfinite(u) ? u : 0.0;
    if (m->wrap == WRAP_REPEAT || m->wrap == WRAP_MIRROR)
        x -= 2.0 * floor(0.5 * x);
    return fmin(fmax(x * size, -0x1p30), 0x1p30);
}

rgb mipmap_nearest(const struct mipmap *m, int level, vec2 uv)
{
    const struct image *image = &m->levels[level];
    return mipmap_texel(m, level, (int)floor(in_texels(m, uv.x, image->width)),
                        (int)floor(in_texels(m, uv.y, image->height)));
}

rgb mipmap_bilinear(const struct mipmap *m, int level, vec2 uv)
{
    const struct image *image = &m->levels[level];
    double x = in_texels(m, uv.x, image->width) - 0.5;
    double y = in_texels(m, uv.y, image->height) - 0.5;
    int column = (int)floor(x), row = (int)floor(y);
    float s = (float)(x - column), t = (float)(y - row);
    rgb upper = rgb_mix(mipmap_texel(m, level, column, row),
                        mipmap_texel(m, level, column + 1, row), s);
    rgb lower = rgb_mix(mipmap_texel(m, level, column, row + 1),
                        mipmap_texel(m, level, column + 1, row + 1), s);
    return rgb_mix(upper, lower, t);
}

/* ---- which level ---- */

/* A step in texture coordinates, in texels of an image; one that is not
 * finite counts as no step. */
struct step {
    double x, y;
};

static struct step step_in_texels(const struct image *image, vec2 d)
{
    struct step none = {0.0, 0.0};
    struct step step = {(double)d.x * image->width,
                        (double)d.y * image->height};
    return isfinite(d.x) && isfinite(d.y) ? step : none;
}

/* log2 of a length in texels of level 0, within the levels that there are. */
static float level_of_length(const struct mipmap *m, double length)
{
    double level = length > 1.0 ? log2(length) : 0.0;
    return (float)fmin(level, m->level_count - 1);
}

float mipmap_level(const struct mipmap *m, vec2 uv_dx, vec2 uv_dy)
{
    struct step dx = step_in_texels(&m->levels[0], uv_dx);
    struct step dy = step_in_texels(&m->levels[0], uv_dy);
    return level_of_length(m, fmax(hypot(dx.x, dx.y), hypot(dy.x, dy.y)));
}

rgb mipmap_trilinear(const struct mipmap *m, vec2 uv, vec2 uv_dx, vec2 uv_dy)
{
    float level = mipmap_level(m, uv_dx, uv_dy);
    int fine = (int)level;
    rgb color = mipmap_bilinear(m, fine, uv);
    if (fine == m->level_count - 1)
        return color;
    return rgb_mix(color, mipmap_bilinear(m, fine + 1, uv),
                   level - (float)fine);
}

/* ---- elliptically weighted average ---- */

/* The points p around the centre with p' E^-1 p <= 1, in texels; E is the
 * symmetric matrix with rows xx xy and xy yy. Its eigenvalues are the squares
 * of the half axes. */
struct ellipse {
    double xx, xy, yy;
};

/* The circle that a pixel's filter has on the film, mapped to the texture: the
 * points s dx + t dy with s s + t t <= 1. */
static struct ellipse footprint_ellipse(struct step dx, struct step dy)
{
    struct ellipse e = {dx.x * dx.x + dy.x * dy.x, dx.x * dx.y + dy.x * dy.y,
                        dx.y * dx.y + dy.y * dy.y};
    return e;
}

/* Makes the ellipse wider where its longest axis is more than ratio times its
 * shortest: the longest stays, all others grow in proportion. The square of
 * the shortest half axis comes out.
 *
 * The squares of the half axes are mean + spread and mean - spread; a matrix
 * keep E + add I has the axes of E and the squares keep * square + add. */
static double limit_anisotropy(struct ellipse *e, double ratio)
{
    double mean = 0.5 * (e->xx + e->yy);
    double spread = hypot(0.5 * (e->xx - e->yy), e->xy);
    double longest = mean + spread, shortest = mean - spread;
    double wanted = longest / (ratio * ratio);
    if (shortest >= wanted)
        return shortest;
    double keep = (longest - wanted) / (longest - shortest);
    double add = wanted - keep * shortest;
    e->xx = keep * e->xx + add;
    e->xy = keep * e->xy;
    e->yy = keep * e->yy + add;
    return wanted;
}

/* Squeezes the ellipse along x or y where it reaches over so many repeats of
 * the image that more would not show: that bounds the work on images of a few
 * texels. */
static void limit_repeats(struct ellipse *e, const struct image *image)
{
    const double repeats = 4.0;
    double x = fmin(1.0, repeats * image->width / sqrt(e->xx));
    double y = fmin(1.0, repeats * image->height / sqrt(e->yy));
    e->xx *= x * x;
    e->xy *= x * y;
    e->yy *= y * y;
}

/* The ellipse in texels of a level, blurred by bilinear interpolation.
 *
 * Interpolation blurs with a variance of 1/6 along each axis, and the weights
 * below have one of 0.21 when the ellipse is the unit circle: so the sum of
 * texels that comes nearest to the integral over the interpolated image adds
 * about 3/4 to the squares of both axes. (Heckbert, whose texels are little
 * Gaussians, adds 1.) It also keeps the ellipse from falling between the
 * texels. */
static struct ellipse ellipse_on_level(const struct ellipse *e,
                                       const struct mipmap *m, int level)
{
    const double texel = 0.75;
    const struct image *image = &m->levels[level];
    double x = (double)image->width / m->levels[0].width;
    double y = (double)image->height / m->levels[0].height;
    struct ellipse on_level = {e->xx * x * x + texel, e->xy * x * y,
                               e->yy * y * y + texel};
    return on_level;
}

/* Beyond this squared distance from the centre (1: on the ellipse) the weight
 * is 0. */
static const double weight_end = 2.0;

/* A Gaussian, lowered so that it has no step at its end. */
static double ewa_weight(double distance2)
{
    const float lowest = 0.018315639f; /* exp(-2 weight_end) */
    return fmaxf(expf(-2.0f * (float)distance2) - lowest, 0.0f);
}

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
        sum_add(sum, mipmap_texel(m, level, x, y), weight);
    }
}

/* The weighted mean of the texels of one level in the ellipse around uv. */
static rgb ewa_on_level(const struct mipmap *m, int level, vec2 uv,
                        const struct ellipse *footprint)
{
    struct ellipse e = ellipse_on_level(footprint, m, level);
    const struct image *image = &m->levels[level];
    double center_x = in_texels(m, uv.x, image->width) - 0.5;
    double center_y = in_texels(m, uv.y, image->height) - 0.5;
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
    return sum_mean(&sum);
}

/* The shortest half axis is this many texels, or up to twice as many, of the
 * finer level used: so the box that made the level blurs less than the
 * ellipse. */
static const double fewest_texels = 1.5;

static const float most_anisotropy = 64.0f;

rgb mipmap_ewa(const struct mipmap *m, vec2 uv, vec2 uv_dx, vec2 uv_dy,
               float max_anisotropy)
{
    const struct image *image = &m->levels[0];
    struct ellipse e = footprint_ellipse(step_in_texels(image, uv_dx),
                                         step_in_texels(image, uv_dy));
    if (e.xx + e.yy == 0.0)
        return mipmap_bilinear(m, 0, uv);
    float ratio = fminf(fmaxf(max_anisotropy, 1.0f), most_anisotropy);
    double shortest = sqrt(limit_anisotropy(&e, ratio));
    limit_repeats(&e, image);
    float level = level_of_length(m, shortest / fewest_texels);
    int fine = (int)level;
    rgb color = ewa_on_level(m, fine, uv, &e);
    if (fine == m->level_count - 1)
        return color;
    return rgb_mix(color, ewa_on_level(m, fine + 1, uv, &e),
                   level - (float)fine);
}
