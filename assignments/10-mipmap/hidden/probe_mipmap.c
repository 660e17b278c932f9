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
#include "base/memory.h"
#include "probe.h"
#include "textures/mipmap.h"

enum { CHANGED_IMAGE = 1 };

struct lookup {
    uint32_t mipmap;
    vec2 uv, uv_dx, uv_dy;
    float max_anisotropy;
};

typedef void run_lookup(struct probe *p, const struct mipmap *m,
                        const struct lookup *l);

/* ---- cases ---- */

static size_t texels_of(const struct image *image)
{
    return (size_t)image->width * (size_t)image->height;
}

static struct image take_image(struct probe *p)
{
    int width = (int)take_word(p), height = (int)take_word(p);
    struct image image = image_make(width, height);
    for (size_t i = 0; i < texels_of(&image); i++)
        image.pixels[i] = take_rgb(p);
    return image;
}

static struct mipmap take_mipmap(struct probe *p)
{
    struct mipmap m;
    memset(&m, 0, sizeof m);
    m.wrap = (enum texture_wrap)take_word(p);
    m.level_count = (int)take_word(p);
    if (m.level_count < 1 || m.level_count > MIPMAP_MAX_LEVELS)
        probe_fail(p, p->input_name,
                   "a mipmap without levels, or with too many");
    for (int i = 0; i < m.level_count; i++)
        m.levels[i] = take_image(p);
    return m;
}

static struct lookup take_lookup(struct probe *p, uint32_t mipmaps)
{
    struct lookup l;
    l.mipmap = take_word(p);
    if (l.mipmap >= mipmaps)
        probe_fail(p, p->input_name, "asks for a mipmap that is not there");
    l.uv = take_vec2(p);
    l.uv_dx = take_vec2(p);
    l.uv_dy = take_vec2(p);
    l.max_anisotropy = take_float(p);
    return l;
}

/* ---- the groups ---- */

static void run_level(struct probe *p, const struct mipmap *m,
                      const struct lookup *l)
{
    put_float(p, mipmap_level(m, l->uv_dx, l->uv_dy));
}

static void run_trilinear(struct probe *p, const struct mipmap *m,
                          const struct lookup *l)
{
    put_rgb(p, mipmap_trilinear(m, l->uv, l->uv_dx, l->uv_dy));
}

static void run_ewa(struct probe *p, const struct mipmap *m,
                    const struct lookup *l)
{
    put_rgb(p, mipmap_ewa(m, l->uv, l->uv_dx, l->uv_dy, l->max_anisotropy));
}

static void run_all(struct probe *p, const struct mipmap *m,
                    const struct lookup *l)
{
    run_level(p, m, l);
    run_trilinear(p, m, l);
    run_ewa(p, m, l);
}

static int half(int size)
{
    return size > 1 ? size / 2 : 1;
}

static void put_level(struct probe *p, const struct image *found, int width,
                      int height)
{
    bool there = found->pixels != NULL;
    put_word(p, there ? (uint32_t)found->width : 0);
    put_word(p, there ? (uint32_t)found->height : 0);
    there = there && found->width == width && found->height == height;
    for (size_t i = 0; i < (size_t)width * (size_t)height; i++)
        put_rgb(p, there ? found->pixels[i] : rgb_grey(0.0f));
}

static void run_pyramid(struct probe *p, struct mipmap *m)
{
    struct image given = m->levels[0];
    size_t bytes = texels_of(&given) * sizeof(rgb);
    rgb *copy =
        memcpy(mem_alloc(texels_of(&given), sizeof(rgb)), given.pixels, bytes);
    uint32_t count = (uint32_t)mipmap_pyramid(m->levels);
    bool same = memcmp(&given, &m->levels[0], sizeof given) == 0 &&
                memcmp(copy, given.pixels, bytes) == 0;
    put_word(p, count);
    put_word(p, same ? 0 : CHANGED_IMAGE);
    int level = 1, width = given.width, height = given.height;
    for (; width > 1 || height > 1; level++) {
        width = half(width);
        height = half(height);
        put_level(p, &m->levels[level], width, height);
    }
    mem_free(copy);
}

static run_lookup *run_of(const struct probe *p)
{
    if (probe_is(p, "level"))
        return run_level;
    if (probe_is(p, "trilinear"))
        return run_trilinear;
    return probe_is(p, "ewa") ? run_ewa : run_all;
}

/* Of a case "hostile", the module itself makes the levels above the first. */
static void run_mipmap(struct probe *p, struct mipmap *m)
{
    if (probe_is(p, "hostile"))
        m->level_count = mipmap_pyramid(m->levels);
    else if (probe_is(p, "pyramid"))
        run_pyramid(p, m);
}

int main(int argc, char **argv)
{
    struct probe p = probe_open("probe_mipmap", argc, argv);
    uint32_t count = take_word(&p);
    struct mipmap *mipmaps = mem_alloc(count, sizeof *mipmaps);
    for (uint32_t i = 0; i < count; i++)
        mipmaps[i] = take_mipmap(&p);
    for (uint32_t i = 0; i < count; i++)
        run_mipmap(&p, &mipmaps[i]);
    run_lookup *run = run_of(&p);
    while (probe_more(&p)) {
        struct lookup lookup = take_lookup(&p, count);
        run(&p, &mipmaps[lookup.mipmap], &lookup);
    }
    return probe_close(&p);
}
