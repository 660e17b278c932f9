/* texture.h - a colour for each point of a surface. */
#ifndef RAYBOOK_TEXTURES_TEXTURE_H
#define RAYBOOK_TEXTURES_TEXTURE_H

#include "base/rgb.h"
#include "base/vec.h"

enum texture_kind { TEXTURE_CONSTANT };

struct texture {
    enum texture_kind kind;
    rgb color; /* TEXTURE_CONSTANT */
};

/* The texture's linear colour at texture coordinates uv. */
rgb texture_color(const struct texture *texture, vec2 uv);

#endif
