/* png.c - see png.h. */
#include "image/png.h"

#include <stb/stb_image_write.h>
#include <stdio.h>

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

/* stb's own way to a file does not tell when the disk is full. */
struct png_file {
    FILE *file;
    bool fine;
};

static void write_bytes(void *user, void *bytes, int size)
{
    struct png_file *out = user;
    size_t count = (size_t)size;
    out->fine = out->fine && fwrite(bytes, 1, count, out->file) == count;
}

static bool write_file(const char *path, const struct image *image)
{
    struct png_file out = {fopen(path, "wb"), true};
    if (out.file == NULL)
        return false;
    uint8_t *bytes = encode(image);
    int made =
        stbi_write_png_to_func(write_bytes, &out, image->width, image->height,
                               3, bytes, 3 * image->width);
    mem_free(bytes);
    bool closed = fclose(out.file) == 0;
    return made && out.fine && closed;
}

bool png_write(const char *path, const struct image *image, struct error *err)
{
    struct replacement aside;
    if (!replace_begin(&aside, path, err))
        return false;
    if (write_file(aside.temporary, image))
        return replace_commit(&aside, err);
    replace_abandon(&aside);
    return error_set(err, "%s: cannot write the picture", path);
}
