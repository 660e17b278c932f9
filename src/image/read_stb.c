/* read_stb.c - see read_stb.h. */
#include "image/read_stb.h"

#include <stb/stb_image.h>
#include <stddef.h>
#include <stdint.h>

#include "base/memory.h"
#include "image/jpeg_check.h"
#include "image/read_limits.h"
#include "image/srgb.h"

/* The value of each of so many codes; the caller owns the table. */
static float *decoding_table(int codes, bool srgb)
{
    float *table = mem_alloc((size_t)codes, sizeof *table);
    for (int i = 0; i < codes; i++) {
        float fraction = (float)i / (float)(codes - 1);
        table[i] = srgb ? srgb_decode(fraction) : fraction;
    }
    return table;
}

/* Of a colour's three 8-bit codes. */
static rgb color_of_8(const stbi_uc codes[3], const float table[256])
{
    return rgb_make(table[codes[0]], table[codes[1]], table[codes[2]]);
}

static rgb color_of_16(const stbi_us codes[3], const float table[65536])
{
    return rgb_make(table[codes[0]], table[codes[1]], table[codes[2]]);
}

static bool load_8(FILE *file, bool srgb, struct image *out)
{
    int width, height, channels;
    stbi_uc *codes = stbi_load_from_file(file, &width, &height, &channels, 3);
    if (codes == NULL)
        return false;
    float *table = decoding_table(256, srgb);
    *out = image_make(width, height);
    size_t count = (size_t)width * (size_t)height;
    for (size_t i = 0; i < count; i++)
        out->pixels[i] = color_of_8(&codes[3 * i], table);
    mem_free(table);
    stbi_image_free(codes);
    return true;
}

static bool load_16(FILE *file, bool srgb, struct image *out)
{
    int width, height, channels;
    stbi_us *codes =
        stbi_load_from_file_16(file, &width, &height, &channels, 3);
    if (codes == NULL)
        return false;
    float *table = decoding_table(65536, srgb);
    *out = image_make(width, height);
    size_t count = (size_t)width * (size_t)height;
    for (size_t i = 0; i < count; i++)
        out->pixels[i] = color_of_16(&codes[3 * i], table);
    mem_free(table);
    stbi_image_free(codes);
    return true;
}

/* The size is in the first chunk, after the signature and the chunk's length
 * and name: two big-endian numbers. */
static bool png_check(FILE *file, const char *path, struct error *err)
{
    unsigned char b[8];
    fseek(file, 16, SEEK_SET);
    if (fread(b, 1, sizeof b, file) != sizeof b)
        return error_set(err, "%s: the PNG file ends in its header", path);
    int64_t width = ((int64_t)b[0] << 24) + (b[1] << 16) + (b[2] << 8) + b[3];
    int64_t height = ((int64_t)b[4] << 24) + (b[5] << 16) + (b[6] << 8) + b[7];
    return image_size_is_fine(path, "the PNG file", width, height, err);
}

bool stb_read(FILE *file, const char *path, bool jpeg, bool srgb,
              struct image *out, struct error *err)
{
    if (!(jpeg ? jpeg_check : png_check)(file, path, err))
        return false;
    rewind(file);
    if (stbi_is_16_bit_from_file(file) ? load_16(file, srgb, out)
                                       : load_8(file, srgb, out))
        return true;
    return error_set(err, "%s: the %s file is damaged or truncated (%s)", path,
                     jpeg ? "JPEG" : "PNG", stbi_failure_reason());
}
