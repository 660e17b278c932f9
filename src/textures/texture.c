/* texture.c - see texture.h. */
#include "textures/texture.h"

#include <stddef.h>

/* ---- a checkerboard; each square is half a unit of u and v wide ---- */

static bool square_is_odd(float x)
{
    return isfinite(x) && fmod(floor(2.0 * x), 2.0) != 0.0;
}

static rgb checkerboard_color(const struct texture *t, vec2 uv)
{
    return t->color[square_is_odd(uv.x) != square_is_odd(uv.y)];
}

/* The integral from 0 to x of a wave that is 1 on even and -1 on odd squares:
 * up and down with the slope 1. */
static double wave_integral(double x)
{
    double rest = x - floor(x);
    return rest < 0.5 ? rest : 1.0 - rest;
}

/* The mean of that wave from delta to delta + scale. */
static double wave_mean(double scale, float delta)
{
    if (scale == 0.0)
        return square_is_odd(delta) ? -1.0 : 1.0;
    return (wave_integral(delta + scale) - wave_integral(delta)) / scale;
}

/* The two colours alternate as the product of a wave in u and one in v. */
static rgb checkerboard_mean(const struct texture *t)
{
    double wave =
        wave_mean(t->scale.x, t->delta.x) * wave_mean(t->scale.y, t->delta.y);
    return rgb_add(rgb_scale(t->color[0], (float)(0.5 + 0.5 * wave)),
                   rgb_scale(t->color[1], (float)(0.5 - 0.5 * wave)));
}

/* ---- an image ---- */

static rgb image_mean(const struct image *image)
{
    double r = 0.0, g = 0.0, b = 0.0;
    size_t count = (size_t)image->width * (size_t)image->height;
    for (size_t i = 0; i < count; i++) {
        r += image->pixels[i].r;
        g += image->pixels[i].g;
        b += image->pixels[i].b;
    }
    double k = 1.0 / (double)count;
    return rgb_make((float)(r * k), (float)(g * k), (float)(b * k));
}

/* ---- any texture ---- */

static vec2 scaled(vec2 a, vec2 scale)
{
    return vec2_make(a.x * scale.x, a.y * scale.y);
}

static vec2 mapped(const struct texture *t, vec2 uv)
{
    vec2 large = scaled(uv, t->scale);
    return vec2_make(large.x + t->delta.x, large.y + t->delta.y);
}

rgb texture_color(const struct texture *texture, const struct texture_point *at)
{
    switch (texture->kind) {
    case TEXTURE_CONSTANT:
        return texture->color[0];
    case TEXTURE_CHECKERBOARD:
        return checkerboard_color(texture, mapped(texture, at->uv));
    default:
        return image_texture_color(&texture->image, mapped(texture, at->uv),
                                   scaled(at->uv_dx, texture->scale),
                                   scaled(at->uv_dy, texture->scale));
    }
}

rgb texture_mean(const struct texture *texture)
{
    const struct mipmap *m = &texture->image.mipmap;
    switch (texture->kind) {
    case TEXTURE_CONSTANT:
        return texture->color[0];
    case TEXTURE_CHECKERBOARD:
        return checkerboard_mean(texture);
    default:
        return image_mean(&m->levels[m->level_count - 1]);
    }
}

bool texture_uses_footprint(const struct texture *texture)
{
    enum texture_filter filter = texture->image.filter;
    return texture->kind == TEXTURE_IMAGE &&
           (filter == FILTER_TRILINEAR || filter == FILTER_EWA);
}

void texture_free(struct texture *texture)
{
    if (texture->kind == TEXTURE_IMAGE)
        mipmap_free(&texture->image.mipmap);
}
