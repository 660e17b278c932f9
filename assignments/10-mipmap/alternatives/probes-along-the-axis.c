/* mipmap.c - assignment 10 with the average as rows of trilinear probes.
 *
 * The pyramid comes from a table of sums over rectangles of the image (F. Crow,
 * "Summed-Area Tables for Texture Mapping", SIGGRAPH 1984), every level by
 * itself. The ellipse is covered by lookups along its longest axis, three
 * abreast, at the level of its shortest (J. McCormack et al., "Feline: Fast
 * Elliptical Lines for Anisotropic Texture Mapping", SIGGRAPH 1999). */
#include "textures/mipmap.h"

#include "base/memory.h"
#include "textures/color_sum.h"
#include "textures/ellipse.h"

/* ---- a table of sums: (x, y) holds the sum over all texels above and left */

struct sums {
    int width, height;
    struct color_sum *at;
};

static struct color_sum *entry(const struct sums *s, int x, int y)
{
    return &s->at[(size_t)y * ((size_t)s->width + 1) + (size_t)x];
}

static struct color_sum plus(struct color_sum a, struct color_sum b, double k)
{
    struct color_sum sum = {a.r + k * b.r, a.g + k * b.g, a.b + k * b.b, 0.0};
    return sum;
}

static struct sums sums_of(const struct image *image)
{
    struct sums s = {image->width, image->height, NULL};
    s.at =
        mem_alloc(((size_t)s.width + 1) * ((size_t)s.height + 1), sizeof *s.at);
    for (int y = 0; y < s.height; y++) {
        struct color_sum row = {0.0, 0.0, 0.0, 0.0};
        for (int x = 0; x < s.width; x++) {
            color_sum_add(&row, image->pixels[y * s.width + x], 1.0);
            *entry(&s, x + 1, y + 1) = plus(row, *entry(&s, x + 1, y), 1.0);
        }
    }
    return s;
}

/* Between the entries the sum is bilinear: texels are squares of one colour. */
static struct color_sum sum_to(const struct sums *s, double x, double y)
{
    int i = (int)fmin(x, s->width - 1), j = (int)fmin(y, s->height - 1);
    double a = x - i, b = y - j;
    struct color_sum sum = {0.0, 0.0, 0.0, 0.0};
    sum = plus(sum, *entry(s, i, j), (1 - a) * (1 - b));
    sum = plus(sum, *entry(s, i + 1, j), a * (1 - b));
    sum = plus(sum, *entry(s, i, j + 1), (1 - a) * b);
    return plus(sum, *entry(s, i + 1, j + 1), a * b);
}

static rgb rectangle_mean(const struct sums *s, double x0, double y0, double x1,
                          double y1)
{
    struct color_sum sum = sum_to(s, x1, y1);
    sum = plus(sum, sum_to(s, x0, y1), -1.0);
    sum = plus(sum, sum_to(s, x1, y0), -1.0);
    sum = plus(sum, sum_to(s, x0, y0), 1.0);
    sum.weight = (x1 - x0) * (y1 - y0);
    return color_sum_mean(&sum);
}

static struct image level_of(const struct sums *s, int width, int height)
{
    struct image image = image_make(width, height);
    double w = (double)s->width / width, h = (double)s->height / height;
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++)
            image.pixels[y * width + x] =
                rectangle_mean(s, x * w, y * h, (x + 1) * w, (y + 1) * h);
    return image;
}

int mipmap_pyramid(struct image levels[MIPMAP_MAX_LEVELS])
{
    struct sums s = sums_of(&levels[0]);
    int count = 1, width = s.width, height = s.height;
    while (width > 1 || height > 1) {
        width = width > 1 ? width / 2 : 1;
        height = height > 1 ? height / 2 : 1;
        levels[count++] = level_of(&s, width, height);
    }
    mem_free(s.at);
    return count;
}

/* ---- lookups */

/* log2, from the exponent and a logarithm of the rest. */
static double log2_of(double x)
{
    int exponent;
    double rest = frexp(x, &exponent);
    return exponent + log(rest) / log(2.0);
}

static double level_for(const struct mipmap *m, double texels)
{
    if (!(texels > 1.0))
        return 0.0;
    return fmin(log2_of(texels), m->level_count - 1);
}

static double texels_along(const struct mipmap *m, vec2 step)
{
    double x = (double)mipmap_finite_step(step).x * m->levels[0].width;
    double y = (double)mipmap_finite_step(step).y * m->levels[0].height;
    return sqrt(x * x + y * y);
}

float mipmap_level(const struct mipmap *m, vec2 uv_dx, vec2 uv_dy)
{
    double a = texels_along(m, uv_dx), b = texels_along(m, uv_dy);
    return (float)level_for(m, a > b ? a : b);
}

static rgb between_levels(const struct mipmap *m, vec2 uv, double level)
{
    int fine = (int)level;
    if (fine >= m->level_count - 1)
        return mipmap_bilinear(m, m->level_count - 1, uv);
    struct color_sum sum = {0.0, 0.0, 0.0, 0.0};
    color_sum_add(&sum, mipmap_bilinear(m, fine, uv), 1.0 - (level - fine));
    color_sum_add(&sum, mipmap_bilinear(m, fine + 1, uv), level - fine);
    return color_sum_mean(&sum);
}

rgb mipmap_trilinear(const struct mipmap *m, vec2 uv, vec2 uv_dx, vec2 uv_dy)
{
    return between_levels(m, uv, (double)mipmap_level(m, uv_dx, uv_dy));
}

/* The ellipse's half axes as steps in texture coordinates: the longest in
 * along, the shortest in across. */
static double set_axes(const struct mipmap *m, const struct ellipse *e,
                       double shortest, double along[2], double across[2])
{
    double spread = hypot(0.5 * (e->xx - e->yy), e->xy);
    double longest = sqrt(0.5 * (e->xx + e->yy) + spread);
    double angle = 0.5 * atan2(2.0 * e->xy, e->xx - e->yy);
    along[0] = longest * cos(angle) / m->levels[0].width;
    along[1] = longest * sin(angle) / m->levels[0].height;
    across[0] = -shortest * sin(angle) / m->levels[0].width;
    across[1] = shortest * cos(angle) / m->levels[0].height;
    return longest;
}

rgb mipmap_ewa(const struct mipmap *m, vec2 uv, vec2 uv_dx, vec2 uv_dy,
               float max_anisotropy)
{
    struct ellipse e = ellipse_of_footprint(m, uv_dx, uv_dy);
    if (e.xx + e.yy == 0.0)
        return mipmap_bilinear(m, 0, uv);
    double shortest = ellipse_widen(&e, max_anisotropy);
    double along[2], across[2];
    double longest = set_axes(m, &e, shortest, along, across);
    double level = level_for(m, 0.7 * shortest);
    int reach = (int)ceil(2.0 * fmin(longest / fmax(shortest, 0.5), 64.0));
    struct color_sum sum = {0.0, 0.0, 0.0, 0.0};
    for (int i = -reach; i <= reach; i++)
        for (int j = -1; j <= 1; j++) {
            double s = 1.4 * i / reach, t = 0.8 * j;
            double u = (double)uv.x + s * along[0] + t * across[0];
            double v = (double)uv.y + s * along[1] + t * across[1];
            color_sum_add(
                &sum, between_levels(m, vec2_make((float)u, (float)v), level),
                exp(-2.0 * (s * s + t * t)));
        }
    return color_sum_mean(&sum);
}
