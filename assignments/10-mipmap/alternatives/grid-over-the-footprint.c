/* mipmap.c - assignment 10 with the average as a grid of lookups.
 *
 * The ellipse is the image of a disc: so take a grid of points of the disc,
 * map each to the texture, look it up bilinearly, and weigh it by its distance
 * in the disc. Each level is taken straight from the image. */
#include "textures/mipmap.h"

#include "textures/color_sum.h"
#include "textures/ellipse.h"

/* How much of texel i lies in [begin, end]. */
static double part_of(int i, double begin, double end)
{
    return fmin(end, i + 1.0) - fmax(begin, i);
}

static rgb area_mean(const struct image *image, double x0, double x1, double y0,
                     double y1)
{
    struct color_sum sum = {0.0, 0.0, 0.0, 0.0};
    for (int y = (int)y0; y < image->height && y < y1; y++)
        for (int x = (int)x0; x < image->width && x < x1; x++)
            color_sum_add(&sum, image->pixels[y * image->width + x],
                          part_of(x, x0, x1) * part_of(y, y0, y1));
    return color_sum_mean(&sum);
}

static void fill_level(const struct image *image, struct image *level)
{
    double w = (double)image->width / level->width;
    double h = (double)image->height / level->height;
    for (int y = 0; y < level->height; y++)
        for (int x = 0; x < level->width; x++)
            level->pixels[y * level->width + x] =
                area_mean(image, x * w, (x + 1) * w, y * h, (y + 1) * h);
}

/* Fills the levels above `last` and returns how many there are in all. */
static int add_levels(struct image levels[], int last)
{
    int width = levels[last].width, height = levels[last].height;
    if (width == 1 && height == 1)
        return last + 1;
    levels[last + 1] =
        image_make(width > 1 ? width >> 1 : 1, height > 1 ? height >> 1 : 1);
    fill_level(&levels[0], &levels[last + 1]);
    return add_levels(levels, last + 1);
}

int mipmap_pyramid(struct image levels[MIPMAP_MAX_LEVELS])
{
    return add_levels(levels, 0);
}

static double level_between(const struct mipmap *m, double level)
{
    return level < 0.0 ? 0.0 : fmin(level, m->level_count - 1.0);
}

float mipmap_level(const struct mipmap *m, vec2 uv_dx, vec2 uv_dy)
{
    double squared = 0.0;
    const vec2 steps[2] = {uv_dx, uv_dy};
    for (int i = 0; i < 2; i++) {
        vec2 d = mipmap_finite_step(steps[i]);
        double x = (double)d.x * m->levels[0].width;
        double y = (double)d.y * m->levels[0].height;
        squared = fmax(squared, x * x + y * y);
    }
    if (squared == 0.0)
        return 0.0f;
    return (float)level_between(m, 0.5 * log2(squared));
}

static rgb at_level(const struct mipmap *m, vec2 uv, double level)
{
    int fine = (int)level;
    double part = level - fine;
    rgb color = mipmap_bilinear(m, fine, uv);
    if (part > 0.0)
        color = rgb_mix(color, mipmap_bilinear(m, fine + 1, uv), (float)part);
    return color;
}

rgb mipmap_trilinear(const struct mipmap *m, vec2 uv, vec2 uv_dx, vec2 uv_dy)
{
    return at_level(m, uv, (double)mipmap_level(m, uv_dx, uv_dy));
}

/* Two perpendicular vectors that span the ellipse: the root of its matrix. */
static void half_axes(const struct ellipse *e, double a[2], double b[2])
{
    double mean = 0.5 * (e->xx + e->yy);
    double spread = hypot(0.5 * (e->xx - e->yy), e->xy);
    double angle = 0.5 * atan2(e->xy, 0.5 * (e->xx - e->yy));
    double longest = sqrt(mean + spread), shortest = sqrt(mean - spread);
    a[0] = longest * cos(angle);
    a[1] = longest * sin(angle);
    b[0] = -shortest * sin(angle);
    b[1] = shortest * cos(angle);
}

enum { ACROSS = 4 };

rgb mipmap_ewa(const struct mipmap *m, vec2 uv, vec2 uv_dx, vec2 uv_dy,
               float max_anisotropy)
{
    struct ellipse e = ellipse_of_footprint(m, uv_dx, uv_dy);
    if (e.xx + e.yy == 0.0)
        return mipmap_bilinear(m, 0, uv);
    double shortest = ellipse_widen(&e, max_anisotropy);
    double a[2], b[2];
    half_axes(&e, a, b);
    double level = level_between(m, log2(fmax(shortest, 1.0)) - 1.0);
    int along = (int)fmin(ceil(ACROSS * hypot(a[0], a[1]) / shortest), 256.0);
    struct color_sum sum = {0.0, 0.0, 0.0, 0.0};
    for (int i = -along; i <= along; i++)
        for (int j = -ACROSS; j <= ACROSS; j++) {
            double s = 1.25 * i / along, t = 1.25 * j / ACROSS;
            double q = s * s + t * t;
            double x = (s * a[0] + t * b[0]) / m->levels[0].width;
            double y = (s * a[1] + t * b[1]) / m->levels[0].height;
            vec2 place =
                vec2_make((float)((double)uv.x + x), (float)((double)uv.y + y));
            if (q < 1.5)
                color_sum_add(&sum, at_level(m, place, level), exp(-2.0 * q));
        }
    return color_sum_mean(&sum);
}
