/* surface_color.h - a texture looked up where a ray met a surface. */
#ifndef RAYBOOK_MATERIALS_SURFACE_COLOR_H
#define RAYBOOK_MATERIALS_SURFACE_COLOR_H

#include "shapes/surface.h"
#include "textures/texture.h"

/* White where there is no texture (NULL). */
static inline rgb surface_color(const struct texture *texture,
                                const struct surface *s)
{
    if (texture == NULL)
        return rgb_grey(1.0f);
    const struct texture_point at = {s->uv, s->uv_dx, s->uv_dy};
    return texture_color(texture, &at);
}

#endif
