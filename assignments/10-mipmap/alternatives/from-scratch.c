/* mipmap.c - assignment 10 with nothing that is given but the images.
 *
 * Its own wrap, its own bilinear lookup, its own ellipse (the eigenvectors of
 * its matrix). The pyramid divides each texel among the texels that it lies
 * in. */
#include "textures/mipmap.h"

struct sum {
    double c[3], weight;
};

static void add(struct sum *s, rgb color, double weight)
{
    s->c[0] += weight * (double)color.r;
    s->c[1] += weight * (double)color.g;
    s->c[2] += weight * (double)color.b;
    s->weight += weight;
}

static rgb mean(const struct sum *s)
{
    return rgb_make((float)(s->c[0] / s->weight), (float)(s->c[1] / s->weight),
                    (float)(s->c[2] / s->weight));
}

/* ---- the pyramid: columns first, then rows ---- */

/* Where the k-th border between `to` parts of `from` texels lies. */
static double border(int k, int from, int to)
{
    return (double)k * from / to;
}

static rgb row_mean(const struct image *image, int y, double begin, double end)
{
    struct sum s = {{0.0}, 0.0};
    for (int x = (int)begin; x < image->width && x < end; x++)
        add(&s, image->pixels[y * image->width + x],
            fmin(x + 1.0, end) - fmax(x, begin));
    return mean(&s);
}

static rgb box_mean(const struct image *image, const double x[2],
                    const double y[2])
{
    struct sum s = {{0.0}, 0.0};
    for (int j = (int)y[0]; j < image->height && j < y[1]; j++)
        add(&s, row_mean(image, j, x[0], x[1]),
            fmin(j + 1.0, y[1]) - fmax(j, y[0]));
    return mean(&s);
}

int mipmap_pyramid(struct image levels[MIPMAP_MAX_LEVELS])
{
    int n = 0;
    while (levels[n].width != 1 || levels[n].height != 1) {
        const struct image *from = &levels[n];
        int w = from->width == 1 ? 1 : from->width / 2;
        int h = from->height == 1 ? 1 : from->height / 2;
        levels[n + 1] = image_make(w, h);
        for (int i = 0; i < w * h; i++) {
            double x[2] = {border(i % w, from->width, w),
                           border(i % w + 1, from->width, w)};
            double y[2] = {border(i / w, from->height, h),
                           border(i / w + 1, from->height, h)};
            levels[n + 1].pixels[i] = box_mean(from, x, y);
        }
        n++;
    }
    return n + 1;
}

/* ---- texels ---- */

/* Which texel of `size` a place stands for; below 0: none. place is a whole
 * number, perhaps a large one. */
static int wrapped(enum texture_wrap wrap, double place, int size)
{
    double period = wrap == WRAP_MIRROR ? 2.0 * size : size;
    if (wrap == WRAP_REPEAT || wrap == WRAP_MIRROR)
        place -= period * floor(place / period);
    if (wrap == WRAP_MIRROR && place >= size)
        place = period - 1.0 - place;
    if (wrap == WRAP_BLACK && !(place >= 0.0 && place < size))
        return -1;
    return (int)fmin(fmax(place, 0.0), size - 1.0);
}

static rgb texel(const struct mipmap *m, const struct image *image, double x,
                 double y)
{
    int column = wrapped(m->wrap, x, image->width);
    int row = wrapped(m->wrap, y, image->height);
    if (column < 0 || row < 0)
        return rgb_grey(0.0f);
    return image->pixels[row * image->width + column];
}

/* Near the image, where a step of one texel makes a difference. */
static double usable(const struct mipmap *m, float u)
{
    if (!isfinite(u))
        return 0.0;
    if (m->wrap == WRAP_REPEAT || m->wrap == WRAP_MIRROR)
        return fmod((double)u, 2.0);
    return fmin(fmax((double)u, -1000.0), 1000.0);
}

static rgb bilinear(const struct mipmap *m, int level, vec2 uv)
{
    const struct image *image = &m->levels[level];
    double x = usable(m, uv.x) * image->width - 0.5;
    double y = usable(m, uv.y) * image->height - 0.5;
    double left = floor(x), top = floor(y);
    struct sum s = {{0.0}, 0.0};
    for (int k = 0; k < 4; k++) {
        double column = left + k % 2, row = top + k / 2;
        add(&s, texel(m, image, column, row),
            (1.0 - fabs(x - column)) * (1.0 - fabs(y - row)));
    }
    return mean(&s);
}

/* ---- levels ---- */

static double clamped(const struct mipmap *m, double length)
{
    double last = m->level_count - 1;
    for (int i = 0; i < m->level_count - 1; i++)
        if (length < ldexp(2.0, i))
            return length > 1.0 ? log(length) / 0.69314718055994531 : 0.0;
    return last;
}

static void in_texels(const struct mipmap *m, vec2 d, double out[2])
{
    bool finite = isfinite(d.x) && isfinite(d.y);
    out[0] = finite ? (double)d.x * m->levels[0].width : 0.0;
    out[1] = finite ? (double)d.y * m->levels[0].height : 0.0;
}

float mipmap_level(const struct mipmap *m, vec2 uv_dx, vec2 uv_dy)
{
    double a[2], b[2];
    in_texels(m, uv_dx, a);
    in_texels(m, uv_dy, b);
    return (float)clamped(m, fmax(hypot(a[0], a[1]), hypot(b[0], b[1])));
}

rgb mipmap_trilinear(const struct mipmap *m, vec2 uv, vec2 uv_dx, vec2 uv_dy)
{
    float level = mipmap_level(m, uv_dx, uv_dy);
    int fine = (int)level, coarse = (int)ceilf(level);
    struct sum s = {{0.0}, 0.0};
    add(&s, bilinear(m, fine, uv), 1.0 - ((double)level - fine));
    add(&s, bilinear(m, coarse, uv), (double)level - fine);
    return mean(&s);
}

/* ---- the average ---- */

/* Half axes as lengths in texels, and the direction of the longer one. */
struct axes {
    double longer, shorter, c, s;
};

static struct axes axes_of(const double a[2], const double b[2])
{
    double xx = a[0] * a[0] + b[0] * b[0], yy = a[1] * a[1] + b[1] * b[1];
    double xy = a[0] * a[1] + b[0] * b[1];
    double angle = 0.5 * atan2(2.0 * xy, xx - yy);
    double spread = sqrt(0.25 * (xx - yy) * (xx - yy) + xy * xy);
    struct axes e = {sqrt(0.5 * (xx + yy) + spread), 0.0, cos(angle),
                     sin(angle)};
    /* The product of the axes is the area of the parallelogram. */
    if (e.longer > 0.0)
        e.shorter = fabs(a[0] * b[1] - a[1] * b[0]) / e.longer;
    return e;
}

static rgb average(const struct mipmap *m, int level, vec2 uv, struct axes e)
{
    const struct image *image = &m->levels[level];
    double to_x = (double)image->width / m->levels[0].width;
    double to_y = (double)image->height / m->levels[0].height;
    double x = usable(m, uv.x) * image->width - 0.5;
    double y = usable(m, uv.y) * image->height - 0.5;
    /* Longer than a texel of this level, so that some texel is in it. */
    double floor_length = 0.9 / fmin(to_x, to_y);
    e.shorter = hypot(e.shorter, floor_length);
    e.longer = hypot(e.longer, floor_length);
    double reach = 1.8 * e.longer;
    double left = ceil(x - reach * to_x), top = ceil(y - reach * to_y);
    struct sum s = {{0.0}, 0.0};
    for (int j = 0; top + j <= y + reach * to_y; j++)
        for (int i = 0; left + i <= x + reach * to_x; i++) {
            double dx = (left + i - x) / to_x, dy = (top + j - y) / to_y;
            double along = (dx * e.c + dy * e.s) / e.longer;
            double across = (dy * e.c - dx * e.s) / e.shorter;
            double q = along * along + across * across;
            if (q < 3.0)
                add(&s, texel(m, image, left + i, top + j), exp(-2.0 * q));
        }
    return mean(&s);
}

rgb mipmap_ewa(const struct mipmap *m, vec2 uv, vec2 uv_dx, vec2 uv_dy,
               float max_anisotropy)
{
    double a[2], b[2];
    in_texels(m, uv_dx, a);
    in_texels(m, uv_dy, b);
    struct axes e = axes_of(a, b);
    if (e.longer == 0.0)
        return bilinear(m, 0, uv);
    e.shorter = fmax(e.shorter, e.longer / (double)max_anisotropy);
    double level = clamped(m, e.shorter / 2.0);
    int fine = (int)level, coarse = (int)ceil(level);
    /* Beyond two repeats of the image nothing is left to see. */
    double most = 2.0 * hypot(m->levels[0].width, m->levels[0].height);
    e.longer = fmin(e.longer, most);
    e.shorter = fmin(e.shorter, most);
    rgb color = average(m, fine, uv, e);
    if (coarse == fine)
        return color;
    struct sum s = {{0.0}, 0.0};
    add(&s, color, 1.0 - (level - fine));
    add(&s, average(m, coarse, uv, e), level - fine);
    return mean(&s);
}
