/* image_texture.c - see image_texture.h. */
#include "textures/image_texture.h"

#include <stddef.h>

const char *const texture_filter_names[] = {"nearest", "bilinear", "trilinear",
                                            "ewa", NULL};

rgb image_texture_color(const struct image_texture *t, vec2 uv, vec2 uv_dx,
                        vec2 uv_dy)
{
    switch (t->filter) {
    case FILTER_NEAREST:
        return mipmap_nearest(&t->mipmap, 0, uv);
    case FILTER_BILINEAR:
        return mipmap_bilinear(&t->mipmap, 0, uv);
    case FILTER_TRILINEAR:
        return mipmap_trilinear(&t->mipmap, uv, uv_dx, uv_dy);
    default:
        return mipmap_ewa(&t->mipmap, uv, uv_dx, uv_dy, t->max_anisotropy);
    }
}
