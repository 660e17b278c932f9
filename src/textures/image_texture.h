/* image_texture.h - an image as a texture: filters and wraps. */
#ifndef RAYBOOK_TEXTURES_IMAGE_TEXTURE_H
#define RAYBOOK_TEXTURES_IMAGE_TEXTURE_H

#include "base/rgb.h"
#include "base/vec.h"
#include "textures/mipmap.h"

enum texture_filter {
    FILTER_NEAREST,
    FILTER_BILINEAR,
    FILTER_TRILINEAR,
    FILTER_EWA
};

/* NULL-terminated, in the order of enum texture_filter. */
extern const char *const texture_filter_names[];

struct image_texture {
    struct mipmap mipmap; /* owned; one level only for nearest and bilinear */
    enum texture_filter filter;
    float max_anisotropy; /* EWA: longest over shortest axis, at least 1 */
};

/* The colour at uv (v = 0 is the top edge, texel centres at half integers)
 * with the footprint uv_dx, uv_dy. */
rgb image_texture_color(const struct image_texture *t, vec2 uv, vec2 uv_dx,
                        vec2 uv_dy);

#endif
