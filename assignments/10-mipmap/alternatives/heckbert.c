/* mipmap.c - assignment 10, as Heckbert and the textbooks have it, in floats.
 *
 * The pyramid halves rows, then columns, with two or three fixed weights. The
 * ellipse is A x^2 + B x y + C y^2 < F with texels that are little Gaussians
 * (one is added to the squares of its axes), the bell a table that ends on the
 * ellipse itself, and the shortest half axis is one to two texels of the finer
 * level. */
#include "textures/mipmap.h"

#include "base/memory.h"
#include "textures/ellipse.h"

/* The weights of texels 2 i, 2 i + 1, 2 i + 2 in texel i of half as many. */
static void half_weights(int size, int i, float weights[3])
{
    float n = (float)(size / 2), whole = (float)size;
    bool odd = size % 2 != 0;
    weights[0] = odd ? (n - (float)i) / whole : 0.5f;
    weights[1] = odd ? n / whole : 0.5f;
    weights[2] = odd ? ((float)i + 1.0f) / whole : 0.0f;
}

/* One row of `size` texels that are `stride` apart, halved in place. */
static void halve_row(rgb *row, int size, size_t stride)
{
    for (int i = 0; i < size / 2; i++) {
        float w[3];
        half_weights(size, i, w);
        rgb *from = row + (size_t)(2 * i) * stride;
        rgb sum =
            rgb_add(rgb_scale(from[0], w[0]), rgb_scale(from[stride], w[1]));
        if (w[2] > 0.0f)
            sum = rgb_add(sum, rgb_scale(from[2 * stride], w[2]));
        row[(size_t)i * stride] = sum;
    }
}

static struct image half_of(const struct image *from)
{
    int width = from->width / 2 > 0 ? from->width / 2 : 1;
    int height = from->height / 2 > 0 ? from->height / 2 : 1;
    size_t stride = (size_t)from->width;
    size_t count = stride * (size_t)from->height;
    rgb *copy = mem_alloc(count, sizeof *copy);
    for (size_t i = 0; i < count; i++)
        copy[i] = from->pixels[i];
    for (int y = 0; y < from->height && from->width > 1; y++)
        halve_row(copy + (size_t)y * stride, from->width, 1);
    for (int x = 0; x < width && from->height > 1; x++)
        halve_row(copy + x, from->height, stride);
    struct image to = image_make(width, height);
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++)
            to.pixels[y * width + x] = copy[(size_t)y * stride + (size_t)x];
    mem_free(copy);
    return to;
}

int mipmap_pyramid(struct image levels[MIPMAP_MAX_LEVELS])
{
    int i = 0;
    for (; levels[i].width * levels[i].height > 1; i++)
        levels[i + 1] = half_of(&levels[i]);
    return i + 1;
}

static float clamped_level(const struct mipmap *m, float level)
{
    return fminf(fmaxf(level, 0.0f), (float)(m->level_count - 1));
}

float mipmap_level(const struct mipmap *m, vec2 uv_dx, vec2 uv_dy)
{
    vec2 a = mipmap_finite_step(uv_dx), b = mipmap_finite_step(uv_dy);
    float w = (float)m->levels[0].width, h = (float)m->levels[0].height;
    float length2 = fmaxf(a.x * w * a.x * w + a.y * h * a.y * h,
                          b.x * w * b.x * w + b.y * h * b.y * h);
    return clamped_level(m, 0.5f * log2f(fmaxf(length2, 1e-30f)));
}

rgb mipmap_trilinear(const struct mipmap *m, vec2 uv, vec2 uv_dx, vec2 uv_dy)
{
    float level = mipmap_level(m, uv_dx, uv_dy);
    int fine = (int)floorf(level);
    int coarse = fine + 1 < m->level_count ? fine + 1 : fine;
    float part = level - (float)fine;
    return rgb_add(rgb_scale(mipmap_bilinear(m, fine, uv), 1.0f - part),
                   rgb_scale(mipmap_bilinear(m, coarse, uv), part));
}

enum { TABLE_SIZE = 1024 };

static float bell(float q)
{
    return expf(-2.0f * q) - expf(-2.0f);
}

static rgb weighted_mean(const struct mipmap *m, int level, vec2 uv,
                         const struct ellipse *footprint)
{
    const struct image *image = &m->levels[level];
    float x_scale = (float)image->width / (float)m->levels[0].width;
    float y_scale = (float)image->height / (float)m->levels[0].height;
    float xx = (float)footprint->xx * x_scale * x_scale + 1.0f;
    float xy = (float)footprint->xy * x_scale * y_scale;
    float yy = (float)footprint->yy * y_scale * y_scale + 1.0f;
    float f = xx * yy - xy * xy;
    float a = yy / f, b = -2.0f * xy / f, c = xx / f;
    float u = (float)mipmap_in_texels(m, uv.x, image->width) - 0.5f;
    float v = (float)mipmap_in_texels(m, uv.y, image->height) - 0.5f;
    rgb sum = rgb_grey(0.0f);
    float weights = 0.0f;
    for (int y = (int)ceilf(v - sqrtf(yy)); (float)y <= v + sqrtf(yy); y++)
        for (int x = (int)ceilf(u - sqrtf(xx)); (float)x <= u + sqrtf(xx);
             x++) {
            float dx = (float)x - u, dy = (float)y - v;
            float q = a * dx * dx + b * dx * dy + c * dy * dy;
            if (q >= 1.0f)
                continue;
            /* As if from a table. */
            int entry = (int)(q * TABLE_SIZE);
            float weight = bell(((float)entry + 0.5f) / TABLE_SIZE);
            rgb texel = mipmap_texel(m, level, x, y);
            sum = rgb_add(sum, rgb_scale(texel, weight));
            weights += weight;
        }
    return rgb_scale(sum, 1.0f / weights);
}

rgb mipmap_ewa(const struct mipmap *m, vec2 uv, vec2 uv_dx, vec2 uv_dy,
               float max_anisotropy)
{
    struct ellipse e = ellipse_of_footprint(m, uv_dx, uv_dy);
    if (e.xx == 0.0 && e.yy == 0.0)
        return mipmap_bilinear(m, 0, uv);
    float shortest = (float)ellipse_widen(&e, max_anisotropy);
    float level = clamped_level(m, log2f(fmaxf(shortest, 1.0f)));
    int fine = (int)level;
    if (fine == m->level_count - 1)
        return mipmap_texel(m, fine, 0, 0);
    rgb a = weighted_mean(m, fine, uv, &e);
    rgb b = weighted_mean(m, fine + 1, uv, &e);
    return rgb_mix(a, b, level - (float)fine);
}
