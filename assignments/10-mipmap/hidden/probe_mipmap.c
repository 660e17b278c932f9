/* probe_mipmap.c - runs a mipmap module on many cases; judges nothing.
 *
 *   probe INPUT OUTPUT GROUP
 *
 * Both files are 32-bit little-endian words (f = IEEE single, u = unsigned).
 * mipmap_cases.py mirrors this layout.
 *
 *   INPUT   u number of mipmaps; of each: u wrap, u number of levels; of each
 *           level: u width, u height, 3 f each texel. Then the lookups, to the
 *           end of the file: u mipmap, 2 f uv, 2 f uv_dx, 2 f uv_dy,
 *           f max_anisotropy
 *   OUTPUT  GROUP "level":     of each lookup f level
 *           GROUP "trilinear": of each lookup 3 f colour
 *           GROUP "ewa":       of each lookup 3 f colour
 *           GROUP "pyramid":   of each mipmap u levels returned, u flags; of
 *                              each level that there should be, but the first:
 *                              u width, u height, 3 f each texel that it should
 *                              have
 *           GROUP "hostile":   of each lookup f level, 3 f, 3 f; on pyramids
 *                              that the module itself made of the first levels
 *
 * A level that is missing or of another size has zeros for its texels. Flags:
 * 1 = levels[0] was changed. */
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "textures/mipmap.h"

enum { CHANGED_IMAGE = 1 };

struct lookup {
    uint32_t mipmap;
    vec2 uv, uv_dx, uv_dy;
    float max_anisotropy;
};

typedef void run_lookup(const struct mipmap *m, const struct lookup *l);

static const char *input_name, *output_name;
static FILE *input, *output;

static void fail(const char *file, const char *what)
{
    fprintf(stderr, "probe_mipmap: %s: %s\n", file, what);
    exit(2);
}

/* ---- words ---- */

static bool get_word(uint32_t *word)
{
    unsigned char b[4];
    size_t got = fread(b, 1, sizeof b, input);
    if (got != 0 && got != sizeof b)
        fail(input_name, "ends inside a word");
    *word = (uint32_t)b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 |
            (uint32_t)b[3] << 24;
    return got != 0;
}

static uint32_t need_word(void)
{
    uint32_t word = 0;
    if (!get_word(&word))
        fail(input_name, "ends too early");
    return word;
}

static float need_float(void)
{
    uint32_t word = need_word();
    float value;
    memcpy(&value, &word, sizeof value);
    return value;
}

static void put_word(uint32_t word)
{
    unsigned char b[4] = {(unsigned char)word, (unsigned char)(word >> 8),
                          (unsigned char)(word >> 16),
                          (unsigned char)(word >> 24)};
    if (fwrite(b, 1, sizeof b, output) != sizeof b)
        fail(output_name, "cannot be written");
}

static void put_float(float value)
{
    uint32_t word;
    memcpy(&word, &value, sizeof word);
    put_word(word);
}

static void put_color(rgb c)
{
    put_float(c.r);
    put_float(c.g);
    put_float(c.b);
}

/* ---- cases ---- */

static size_t texels_of(const struct image *image)
{
    return (size_t)image->width * (size_t)image->height;
}

static struct image need_image(void)
{
    int width = (int)need_word(), height = (int)need_word();
    struct image image = image_make(width, height);
    for (size_t i = 0; i < texels_of(&image); i++) {
        image.pixels[i].r = need_float();
        image.pixels[i].g = need_float();
        image.pixels[i].b = need_float();
    }
    return image;
}

static struct mipmap need_mipmap(void)
{
    struct mipmap m;
    memset(&m, 0, sizeof m);
    m.wrap = (enum texture_wrap)need_word();
    m.level_count = (int)need_word();
    if (m.level_count < 1 || m.level_count > MIPMAP_MAX_LEVELS)
        fail(input_name, "a mipmap without levels, or with too many");
    for (int i = 0; i < m.level_count; i++)
        m.levels[i] = need_image();
    return m;
}

static vec2 need_vec2(void)
{
    float x = need_float(), y = need_float();
    return vec2_make(x, y);
}

static bool get_lookup(struct lookup *l)
{
    if (!get_word(&l->mipmap))
        return false;
    l->uv = need_vec2();
    l->uv_dx = need_vec2();
    l->uv_dy = need_vec2();
    l->max_anisotropy = need_float();
    return true;
}

/* ---- the groups ---- */

static void run_level(const struct mipmap *m, const struct lookup *l)
{
    put_float(mipmap_level(m, l->uv_dx, l->uv_dy));
}

static void run_trilinear(const struct mipmap *m, const struct lookup *l)
{
    put_color(mipmap_trilinear(m, l->uv, l->uv_dx, l->uv_dy));
}

static void run_ewa(const struct mipmap *m, const struct lookup *l)
{
    put_color(mipmap_ewa(m, l->uv, l->uv_dx, l->uv_dy, l->max_anisotropy));
}

static void run_all(const struct mipmap *m, const struct lookup *l)
{
    run_level(m, l);
    run_trilinear(m, l);
    run_ewa(m, l);
}

static int half(int size)
{
    return size > 1 ? size / 2 : 1;
}

static void put_level(const struct image *found, int width, int height)
{
    bool there = found->pixels != NULL;
    put_word(there ? (uint32_t)found->width : 0);
    put_word(there ? (uint32_t)found->height : 0);
    there = there && found->width == width && found->height == height;
    for (size_t i = 0; i < (size_t)width * (size_t)height; i++)
        put_color(there ? found->pixels[i] : rgb_grey(0.0f));
}

static void run_pyramid(struct mipmap *m)
{
    struct image given = m->levels[0];
    size_t bytes = texels_of(&given) * sizeof(rgb);
    rgb *copy =
        memcpy(mem_alloc(texels_of(&given), sizeof(rgb)), given.pixels, bytes);
    uint32_t count = (uint32_t)mipmap_pyramid(m->levels);
    bool same = memcmp(&given, &m->levels[0], sizeof given) == 0 &&
                memcmp(copy, given.pixels, bytes) == 0;
    put_word(count);
    put_word(same ? 0 : CHANGED_IMAGE);
    int level = 1, width = given.width, height = given.height;
    for (; width > 1 || height > 1; level++) {
        width = half(width);
        height = half(height);
        put_level(&m->levels[level], width, height);
    }
    mem_free(copy);
}

static run_lookup *run_of(const char *group)
{
    if (strcmp(group, "level") == 0)
        return run_level;
    if (strcmp(group, "trilinear") == 0)
        return run_trilinear;
    return strcmp(group, "ewa") == 0 ? run_ewa : run_all;
}

static FILE *open_or_fail(const char *name, const char *mode)
{
    FILE *file = fopen(name, mode);
    if (!file)
        fail(name, "cannot be opened");
    return file;
}

int main(int argc, char **argv)
{
    if (argc != 4) {
        fprintf(stderr, "usage: probe_mipmap INPUT OUTPUT GROUP\n");
        return 2;
    }
    input = open_or_fail(input_name = argv[1], "rb");
    output = open_or_fail(output_name = argv[2], "wb");
    uint32_t count = need_word();
    struct mipmap *mipmaps = mem_alloc(count, sizeof *mipmaps);
    for (uint32_t i = 0; i < count; i++)
        mipmaps[i] = need_mipmap();
    bool own_pyramids = strcmp(argv[3], "hostile") == 0;
    for (uint32_t i = 0; i < count; i++)
        if (own_pyramids)
            mipmaps[i].level_count = mipmap_pyramid(mipmaps[i].levels);
        else if (strcmp(argv[3], "pyramid") == 0)
            run_pyramid(&mipmaps[i]);
    struct lookup lookup;
    while (get_lookup(&lookup)) {
        if (lookup.mipmap >= count)
            fail(input_name, "asks for a mipmap that is not there");
        run_of(argv[3])(&mipmaps[lookup.mipmap], &lookup);
    }
    if (fclose(output) != 0)
        fail(output_name, "cannot be written");
    return 0;
}
