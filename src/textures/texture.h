/* texture.h - a colour for each point of a surface. */
#ifndef RAYBOOK_TEXTURES_TEXTURE_H
#define RAYBOOK_TEXTURES_TEXTURE_H

#include "base/rgb.h"
#include "base/vec.h"
#include "textures/image_texture.h"

enum texture_kind { TEXTURE_CONSTANT, TEXTURE_CHECKERBOARD, TEXTURE_IMAGE };

/* What a lookup knows: texture coordinates, and how they change to the pixel
 * on the right and the one below (zero: the pixel sees a single point). */
struct texture_point {
    vec2 uv, uv_dx, uv_dy;
};

/* scale and delta map texture coordinates: uv' = uv * scale + delta. */
struct texture {
    enum texture_kind kind;
    rgb color[2];               /* the constant; or even and odd squares */
    struct image_texture image; /* TEXTURE_IMAGE; owned */
    vec2 scale, delta;
};

/* The texture's linear colour. A checkerboard has color[0] where
 * floor(2 u') + floor(2 v') is even; it is not filtered. */
rgb texture_color(const struct texture *texture,
                  const struct texture_point *at);

/* The mean colour over the unit square of texture coordinates; of an image the
 * mean of its texels, whatever scale and delta are. */
rgb texture_mean(const struct texture *texture);

/* Does a lookup use uv_dx and uv_dy? */
bool texture_uses_footprint(const struct texture *texture);

void texture_free(struct texture *texture);

#endif
