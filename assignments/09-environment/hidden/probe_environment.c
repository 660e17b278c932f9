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
#include "lights/environment_map.h"
#include "probe.h"

enum { OTHER_DIRECTION = 1 };

static struct transform take_rotation(struct probe *p)
{
    float rows[16] = {0};
    struct transform t;
    for (int i = 0; i < 9; i++)
        rows[i / 3 * 4 + i % 3] = take_float(p);
    rows[15] = 1.0f;
    if (!transform_from_rows(rows, &t))
        probe_fail(p, p->input_name, "a rotation has no inverse");
    return t;
}

static struct image take_image(struct probe *p, uint32_t width, uint32_t height)
{
    if (width - 1 >= 4096 || height - 1 >= 4096)
        probe_fail(p, p->input_name, "an image is too large or empty");
    struct image image = image_make((int)width, (int)height);
    for (uint32_t i = 0; i < width * height; i++)
        image.pixels[i] = take_rgb(p);
    return image;
}

static void ask_direction(struct probe *p, const struct environment *e)
{
    vec3 direction = take_vec3(p);
    put_rgb(p, environment_radiance(e, direction));
    put_float(p, environment_pdf(e, direction));
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
static void ask_pick(struct probe *p, const struct environment *e)
{
    vec3 d = {0.0f, 0.0f, 1.0f}, other, again = d;
    vec2 random = take_vec2(p);
    float density = environment_sample(e, random, &d);
    environment_sample(e, vec2_make(0.5f * random.y, 0.5f * random.x), &other);
    float same = environment_sample(e, random, &again);
    put_vec3(p, d);
    put_float(p, density);
    bool usable = density != 0.0f && vec3_is_finite(d);
    vec3 asked = usable ? vec3_normalize(d) : vec3_make(0.0f, 0.0f, 1.0f);
    put_float(p, environment_pdf(e, asked));
    for (int turn = 0; turn < 4; turn++)
        put_float(p, environment_pdf(e, beside(asked, turn)));
    bool differs = memcmp(&d, &again, sizeof d) != 0 ||
                   memcmp(&density, &same, sizeof same) != 0;
    put_word(p, differs ? OTHER_DIRECTION : 0);
}

static void ask_block(struct probe *p)
{
    uint32_t width = take_word(p), height = take_word(p);
    uint32_t directions = take_word(p), pairs = take_word(p);
    float scale = take_float(p);
    struct transform rotation = take_rotation(p);
    struct image image = take_image(p, width, height);
    struct environment e = environment_make(&image, scale, rotation);
    /* A second one: each has its own table. */
    struct image grey = image_make(2, 2);
    grey.pixels[3] = rgb_grey(1.0f);
    struct environment other =
        environment_make(&grey, 1.0f, transform_identity());
    for (uint32_t i = 0; i < directions; i++)
        ask_direction(p, &e);
    for (uint32_t i = 0; i < pairs; i++)
        ask_pick(p, &e);
    environment_free(&other);
    environment_free(&e);
    image_free(&grey);
    image_free(&image);
}

int main(int argc, char **argv)
{
    struct probe p = probe_open("probe_environment", argc, argv);
    while (probe_more(&p))
        ask_block(&p);
    return probe_close(&p);
}
