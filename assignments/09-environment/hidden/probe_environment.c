/* probe_environment.c - asks an environment module about many directions;
 * judges nothing.
 *
 *   probe INPUT OUTPUT GROUP
 *
 * Both files are 32-bit little-endian words (u = unsigned, f = IEEE single).
 * environment_probe.py mirrors this layout; GROUP changes nothing. INPUT is one
 * block after another, each a map and what to ask about it:
 *
 *   4 u   width, height, how many directions, how many pairs of numbers
 *   1 f   scale
 *   9 f   the rotation to the world, row by row
 *   3 f   for each texel, row by row: r, g, b
 *   3 f   for each direction: x, y, z
 *   2 f   for each pair of random numbers: x, y
 *
 * OUTPUT has for each block
 *
 *   4 f   for each direction: its radiance r, g, b; its density
 *  10     for each pair: 3 f the direction that was picked; f the density that
 *         was returned; f environment_pdf of the direction, and 4 f of four
 *         directions 2e-5 beside it; u flags: 1 = the same numbers gave
 *         something else the second time */
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lights/environment_map.h"

enum { OTHER_DIRECTION = 1 };

static void fail(const char *file, const char *what)
{
    fprintf(stderr, "probe_environment: %s: %s\n", file, what);
    exit(2);
}

struct files {
    const char *input_name, *output_name;
    FILE *input, *output;
};

/* The next word; false at the end of the file. */
static bool read_word(struct files *f, uint32_t *word)
{
    unsigned char b[4];
    size_t got = fread(b, 1, 4, f->input);
    if (ferror(f->input))
        fail(f->input_name, "cannot be read");
    if (got != 0 && got != 4)
        fail(f->input_name, "ends inside a word");
    *word = (uint32_t)b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 |
            (uint32_t)b[3] << 24;
    return got == 4;
}

static uint32_t need_word(struct files *f)
{
    uint32_t word;
    if (!read_word(f, &word))
        fail(f->input_name, "ends inside a block; expected whole blocks");
    return word;
}

static float need_float(struct files *f)
{
    uint32_t word = need_word(f);
    float value;
    memcpy(&value, &word, sizeof value);
    return value;
}

static void write_word(struct files *f, uint32_t word)
{
    unsigned char b[4];
    for (int i = 0; i < 4; i++)
        b[i] = (unsigned char)(word >> (8 * i));
    if (fwrite(b, 1, 4, f->output) != 4)
        fail(f->output_name, "cannot be written");
}

static void write_float(struct files *f, float value)
{
    uint32_t word;
    memcpy(&word, &value, sizeof word);
    write_word(f, word);
}

static vec3 need_vec3(struct files *f)
{
    float x = need_float(f), y = need_float(f);
    return vec3_make(x, y, need_float(f));
}

static struct transform need_rotation(struct files *f)
{
    float rows[16] = {0};
    struct transform t;
    for (int i = 0; i < 9; i++)
        rows[i / 3 * 4 + i % 3] = need_float(f);
    rows[15] = 1.0f;
    if (!transform_from_rows(rows, &t))
        fail(f->input_name, "a rotation has no inverse");
    return t;
}

static struct image need_image(struct files *f, uint32_t width, uint32_t height)
{
    if (width - 1 >= 4096 || height - 1 >= 4096)
        fail(f->input_name, "an image is too large or empty");
    struct image image = image_make((int)width, (int)height);
    for (uint32_t i = 0; i < width * height; i++) {
        vec3 c = need_vec3(f);
        image.pixels[i] = rgb_make(c.x, c.y, c.z);
    }
    return image;
}

static void ask_direction(struct files *f, const struct environment *e)
{
    vec3 direction = need_vec3(f);
    rgb c = environment_radiance(e, direction);
    write_float(f, c.r);
    write_float(f, c.g);
    write_float(f, c.b);
    write_float(f, environment_pdf(e, direction));
}

/* A direction just beside d, turned by `turn` quarters. */
static vec3 beside(vec3 d, int turn)
{
    vec3 s, t;
    vec3_frame(d, &s, &t);
    vec3 way = turn % 2 ? s : t;
    return vec3_normalize(vec3_step(d, turn < 2 ? 2e-5f : -2e-5f, way));
}

/* Other numbers are asked between the two picks: none may be remembered. */
static void ask_pick(struct files *f, const struct environment *e)
{
    vec3 d = {0.0f, 0.0f, 1.0f}, other, again = d;
    float x = need_float(f), y = need_float(f);
    float density = environment_sample(e, vec2_make(x, y), &d);
    environment_sample(e, vec2_make(0.5f * y, 0.5f * x), &other);
    float same = environment_sample(e, vec2_make(x, y), &again);
    write_float(f, d.x);
    write_float(f, d.y);
    write_float(f, d.z);
    write_float(f, density);
    bool usable = density != 0.0f && vec3_is_finite(d);
    vec3 asked = usable ? vec3_normalize(d) : vec3_make(0.0f, 0.0f, 1.0f);
    write_float(f, environment_pdf(e, asked));
    for (int turn = 0; turn < 4; turn++)
        write_float(f, environment_pdf(e, beside(asked, turn)));
    bool differs = memcmp(&d, &again, sizeof d) != 0 ||
                   memcmp(&density, &same, sizeof same) != 0;
    write_word(f, differs ? OTHER_DIRECTION : 0);
}

/* false at the end of the file. */
static bool ask_block(struct files *f)
{
    uint32_t width;
    if (!read_word(f, &width))
        return false;
    uint32_t height = need_word(f);
    uint32_t directions = need_word(f), pairs = need_word(f);
    float scale = need_float(f);
    struct transform rotation = need_rotation(f);
    struct image image = need_image(f, width, height);
    struct environment e = environment_make(&image, scale, rotation);
    /* A second one: each has its own table. */
    struct image grey = image_make(2, 2);
    grey.pixels[3] = rgb_grey(1.0f);
    struct environment other =
        environment_make(&grey, 1.0f, transform_identity());
    for (uint32_t i = 0; i < directions; i++)
        ask_direction(f, &e);
    for (uint32_t i = 0; i < pairs; i++)
        ask_pick(f, &e);
    environment_free(&other);
    environment_free(&e);
    image_free(&grey);
    image_free(&image);
    return true;
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
        fprintf(stderr, "usage: probe_environment INPUT OUTPUT GROUP\n");
        return 2;
    }
    struct files f = {argv[1], argv[2], open_or_fail(argv[1], "rb"),
                      open_or_fail(argv[2], "wb")};
    while (ask_block(&f))
        continue;
    if (fclose(f.output) != 0)
        fail(argv[2], "cannot be written");
    fclose(f.input);
    return 0;
}
