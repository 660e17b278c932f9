/* levels.c - see levels.h. */
#include "textures/levels.h"

#include "textures/mipmap.h"

const char *const texture_wrap_names[] = {"repeat", "clamp", "mirror", "black",
                                          NULL};

/* ---- making and freeing ---- */

struct mipmap mipmap_make(struct image image, enum texture_wrap wrap,
                          bool whole)
{
    struct mipmap m = {{image}, 1, wrap};
    if (whole)
        m.level_count = mipmap_pyramid(m.levels);
    return m;
}

void mipmap_free(struct mipmap *m)
{
    for (int i = 0; i < m->level_count; i++)
        image_free(&m->levels[i]);
    m->level_count = 0;
}

/* ---- texels ---- */

//> levels.wrap: Wrap an index
/* The remainder that lies in 0 .. n - 1, also of a negative i. Mostly i is next
 * to that range, and takes no division, which is slow. */
static int floor_mod(int i, int n)
{
    if (i < 0)
        i += n;
    else if (i >= n)
        i -= n;
    if (i >= 0 && i < n)
        return i;
    int remainder = i % n;
    return remainder < 0 ? remainder + n : remainder;
}

/* Which of size texels the wrap puts at index i; -1: none. */
static int wrap_index(enum texture_wrap wrap, int i, int size)
{
    if (i >= 0 && i < size)
        return i;
    switch (wrap) {
    case WRAP_REPEAT:
        return floor_mod(i, size);
    case WRAP_CLAMP:
        return i < 0 ? 0 : size - 1;
    case WRAP_MIRROR:
        i = floor_mod(i, 2 * size);
        return i < size ? i : 2 * size - 1 - i;
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
//< levels.wrap

/* ---- places between the texels ---- */

//> levels.lookup: Look up a place between the texels
double mipmap_in_texels(const struct mipmap *m, float u, int size)
{
    double x = isfinite(u) ? u : 0.0;
    if (m->wrap == WRAP_REPEAT || m->wrap == WRAP_MIRROR)
        x -= 2.0 * floor(0.5 * x);
    return fmin(fmax(x * size, -0x1p30), 0x1p30);
}

vec2 mipmap_finite_step(vec2 step)
{
    vec2 none = {0.0f, 0.0f};
    return isfinite(step.x) && isfinite(step.y) ? step : none;
}

rgb mipmap_nearest(const struct mipmap *m, int level, vec2 uv)
{
    const struct image *image = &m->levels[level];
    double x = mipmap_in_texels(m, uv.x, image->width);
    double y = mipmap_in_texels(m, uv.y, image->height);
    return mipmap_texel(m, level, (int)floor(x), (int)floor(y));
}

rgb mipmap_bilinear(const struct mipmap *m, int level, vec2 uv)
{
    const struct image *image = &m->levels[level];
    double x = mipmap_in_texels(m, uv.x, image->width) - 0.5;
    double y = mipmap_in_texels(m, uv.y, image->height) - 0.5;
    int column = (int)floor(x), row = (int)floor(y);
    float s = (float)(x - column), t = (float)(y - row);
    rgb upper = rgb_mix(mipmap_texel(m, level, column, row),
                        mipmap_texel(m, level, column + 1, row), s);
    rgb lower = rgb_mix(mipmap_texel(m, level, column, row + 1),
                        mipmap_texel(m, level, column + 1, row + 1), s);
    return rgb_mix(upper, lower, t);
}
//< levels.lookup
