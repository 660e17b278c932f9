/* probe_rect_light.c - runs an area light module on many cases; judges nothing.
 *
 *   probe INPUT OUTPUT GROUP
 *
 * Both files are arrays of records of 32-bit little-endian words (IEEE single
 * but for the flags); OUTPUT has one record for each of INPUT, in order.
 * oracle_rect_light.py and oracle_lamp.py mirror this layout. A rect is 13
 * words: center, side_x, side_y, normal (x y z each), area.
 *
 * GROUP "density":
 *   in   10   point, on_light, normal, area
 *   out   1   area_light_pdf
 * GROUP "emitted":
 *   in    9   radiance (r g b), normal, outgoing
 *   out   3   area_light_emitted
 * Any other GROUP:
 *   in   21   rect, random x and y, point, radiance
 *   out   8   the place that was picked; area_light_pdf of it; what it emits
 *             towards the point (r g b); flags: 1 = the same numbers gave
 *             another place the second time */
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lights/rect_light.h"

enum { OTHER_PLACE = 1 };
enum { MOST_IN = 21, MOST_OUT = 8 };

typedef void run_case(const float *in, uint32_t *out);

static void fail(const char *file, const char *what)
{
    fprintf(stderr, "probe_rect_light: %s: %s\n", file, what);
    exit(2);
}

static void put(uint32_t *out, float value)
{
    memcpy(out, &value, sizeof value);
}

static void put_three(uint32_t *out, float a, float b, float c)
{
    put(out, a);
    put(out + 1, b);
    put(out + 2, c);
}

static vec3 take_vec3(const float *in)
{
    return vec3_make(in[0], in[1], in[2]);
}

static void run_density(const float *in, uint32_t *out)
{
    put(out, area_light_pdf(take_vec3(in), take_vec3(in + 3), take_vec3(in + 6),
                            in[9]));
}

static void run_emitted(const float *in, uint32_t *out)
{
    rgb c = area_light_emitted(rgb_make(in[0], in[1], in[2]), take_vec3(in + 3),
                               take_vec3(in + 6));
    put_three(out, c.r, c.g, c.b);
}

/* Other numbers are asked between the two picks: none may be remembered. */
static void run_light(const float *in, uint32_t *out)
{
    const struct rect rect = {take_vec3(in), take_vec3(in + 3),
                              take_vec3(in + 6), take_vec3(in + 9), in[12]};
    vec2 random = vec2_make(in[13], in[14]);
    vec3 point = take_vec3(in + 15);
    vec3 place = rect_light_place(&rect, random);
    rect_light_place(&rect, vec2_make(0.5f * random.y, 0.5f * random.x));
    vec3 again = rect_light_place(&rect, random);
    put_three(out, place.x, place.y, place.z);
    put(out + 3, area_light_pdf(point, place, rect.normal, rect.area));
    rgb c = area_light_emitted(rgb_make(in[18], in[19], in[20]), rect.normal,
                               vec3_sub(point, place));
    put_three(out + 4, c.r, c.g, c.b);
    out[7] = memcmp(&place, &again, sizeof place) != 0 ? OTHER_PLACE : 0;
}

/* The next record of `words` words; false at the end of the file. */
static bool read_record(FILE *file, const char *name, float *record,
                        size_t words)
{
    unsigned char bytes[4 * MOST_IN];
    size_t got = fread(bytes, 1, 4 * words, file);
    if (ferror(file))
        fail(name, "cannot be read");
    if (got == 0)
        return false;
    if (got != 4 * words)
        fail(name, "ends inside a record; expected whole records of cases");
    for (size_t i = 0; i < words; i++) {
        const unsigned char *b = bytes + 4 * i;
        uint32_t word = (uint32_t)b[0] | (uint32_t)b[1] << 8 |
                        (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
        memcpy(&record[i], &word, sizeof word);
    }
    return true;
}

static void write_record(FILE *file, const char *name, const uint32_t *record,
                         size_t words)
{
    unsigned char bytes[4 * MOST_OUT];
    for (size_t i = 0; i < 4 * words; i++)
        bytes[i] = (unsigned char)(record[i / 4] >> (8 * (i % 4)));
    if (fwrite(bytes, 1, 4 * words, file) != 4 * words)
        fail(name, "cannot be written");
}

static FILE *open_or_fail(const char *name, const char *mode)
{
    FILE *file = fopen(name, mode);
    if (!file)
        fail(name, "cannot be opened");
    return file;
}

/* Which function a group asks, and how long its records are. */
struct group {
    const char *name;
    run_case *run;
    size_t in, out;
};

static const struct group *find_group(const char *name)
{
    static const struct group groups[] = {{"density", run_density, 10, 1},
                                          {"emitted", run_emitted, 9, 3},
                                          {NULL, run_light, MOST_IN, MOST_OUT}};
    const struct group *group = groups;
    while (group->name && strcmp(group->name, name) != 0)
        group++;
    return group;
}

int main(int argc, char **argv)
{
    if (argc != 4) {
        fprintf(stderr, "usage: probe_rect_light INPUT OUTPUT GROUP\n");
        return 2;
    }
    const struct group *group = find_group(argv[3]);
    FILE *input = open_or_fail(argv[1], "rb");
    FILE *output = open_or_fail(argv[2], "wb");
    float in[MOST_IN];
    while (read_record(input, argv[1], in, group->in)) {
        uint32_t out[MOST_OUT] = {0};
        group->run(in, out);
        write_record(output, argv[2], out, group->out);
    }
    if (fclose(output) != 0)
        fail(argv[2], "cannot be written");
    fclose(input);
    return 0;
}
