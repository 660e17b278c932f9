/* png.c - see png.h. */
#include "image/png.h"

#include <stb/stb_image_write.h>

#include "base/memory.h"
#include "image/replace.h"

uint8_t srgb_encode(float linear)
{
    if (!(linear > 0.0f))
        return 0;
    if (linear >= 1.0f)
        return 255;
    float code = linear <= 0.0031308f
                     ? 12.92f * linear
                     : 1.055f * powf(linear, 1.0f / 2.4f) - 0.055f;
    return (uint8_t)(255.0f * code + 0.5f);
}

static uint8_t *encode(const struct image *image)
{
    size_t count = (size_t)image->width * (size_t)image->height;
    uint8_t *bytes = mem_alloc(count, 3);
    for (size_t i = 0; i < count; i++) {
        bytes[3 * i] = srgb_encode(image->pixels[i].r);
        bytes[3 * i + 1] = srgb_encode(image->pixels[i].g);
        bytes[3 * i + 2] = srgb_encode(image->pixels[i].b);
    }
    return bytes;
}

bool png_write(const char *path, const struct image *image, struct error *err)
{
    struct replacement aside;
    if (!replace_begin(&aside, path, err))
        return false;
    uint8_t *bytes = encode(image);
    int written = stbi_write_png(aside.temporary, image->width, image->height,
                                 3, bytes, 3 * image->width);
    mem_free(bytes);
    if (written)
        return replace_commit(&aside, err);
    replace_abandon(&aside);
    return error_set(err, "%s: cannot write the picture", path);
}
