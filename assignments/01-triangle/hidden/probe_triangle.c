/* probe_triangle.c - runs a triangle module on many cases; judges nothing.
 *
 *   probe INPUT OUTPUT GROUP
 *
 * Both files are arrays of records of 32-bit little-endian words (f = IEEE
 * single, u = unsigned); OUTPUT has one record for each of INPUT, in order.
 * oracle_triangle.py and oracle_differentials.py mirror this layout.
 *
 * GROUP "differentials":
 *   in   15 f   corners p0 p1 p2 (x y z each), uv0 uv1 uv2 (u v each)
 *   out   8     u returned true (1) or false (0), 3 f dp_du, 3 f dp_dv,
 *               u flags
 * GROUP "hostile": the layout of "differentials" is laid over that of any
 *   other, and both functions are called; what they say is not told.
 * Any other GROUP:
 *   in   17 f   corners p0 p1 p2, ray origin, direction, t_min, t_max
 *   out   5     u returned true (1) or false (0), f t, f b1, f b2, u flags
 *
 * A function that returned false has zeros for its vectors or t, b1, b2.
 * Flags: 1 = returned false, yet wrote to its results; 2 = changed the ray. */
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "shapes/triangle.h"

enum { WROTE_ON_FALSE = 1, CHANGED_RAY = 2 };
enum { INTERSECT_IN = 17, INTERSECT_OUT = 5 };
enum { DIFFERENTIALS_IN = 15, DIFFERENTIALS_OUT = 8 };

/* What results hold before the call: no case has this for an answer. */
static const float UNTOUCHED = -12345.6787f;

typedef void run_case(const float *in, uint32_t *out);

static void fail(const char *file, const char *what)
{
    fprintf(stderr, "probe_triangle: %s: %s\n", file, what);
    exit(2);
}

static uint32_t word_of(float value)
{
    uint32_t word;
    memcpy(&word, &value, sizeof word);
    return word;
}

static void put_vec3(uint32_t *out, vec3 v)
{
    out[0] = word_of(v.x);
    out[1] = word_of(v.y);
    out[2] = word_of(v.z);
}

static vec3 take_vec3(const float *in)
{
    return vec3_make(in[0], in[1], in[2]);
}

static void run_intersect(const float *in, uint32_t *out)
{
    const vec3 p[3] = {take_vec3(in), take_vec3(in + 3), take_vec3(in + 6)};
    const ray given =
        ray_make(take_vec3(in + 9), take_vec3(in + 12), in[15], in[16]);
    const struct triangle_hit untouched = {UNTOUCHED, UNTOUCHED, UNTOUCHED};
    ray used = given;
    struct triangle_hit hit = untouched;
    bool found = triangle_intersect(p, &used, &hit);
    if (found) {
        out[0] = 1;
        out[1] = word_of(hit.t);
        out[2] = word_of(hit.b1);
        out[3] = word_of(hit.b2);
    } else if (memcmp(&hit, &untouched, sizeof hit) != 0) {
        out[4] |= WROTE_ON_FALSE;
    }
    if (memcmp(&used, &given, sizeof used) != 0)
        out[4] |= CHANGED_RAY;
}

static void run_differentials(const float *in, uint32_t *out)
{
    const vec3 p[3] = {take_vec3(in), take_vec3(in + 3), take_vec3(in + 6)};
    const vec2 uv[3] = {{in[9], in[10]}, {in[11], in[12]}, {in[13], in[14]}};
    const vec3 untouched = {UNTOUCHED, UNTOUCHED, UNTOUCHED};
    vec3 dp_du = untouched, dp_dv = untouched;
    if (triangle_uv_differentials(p, uv, &dp_du, &dp_dv)) {
        out[0] = 1;
        put_vec3(out + 1, dp_du);
        put_vec3(out + 4, dp_dv);
    } else if (memcmp(&dp_du, &untouched, sizeof dp_du) != 0 ||
               memcmp(&dp_dv, &untouched, sizeof dp_dv) != 0) {
        out[7] |= WROTE_ON_FALSE;
    }
}

static void run_both(const float *in, uint32_t *out)
{
    run_differentials(in, out);
    run_intersect(in, out);
}

/* The next record of `words` words; false at the end of the file. */
static bool read_record(FILE *file, const char *name, float *record,
                        size_t words)
{
    unsigned char bytes[4 * INTERSECT_IN];
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
    unsigned char bytes[4 * DIFFERENTIALS_OUT];
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

int main(int argc, char **argv)
{
    if (argc != 4) {
        fprintf(stderr, "usage: probe_triangle INPUT OUTPUT GROUP\n");
        return 2;
    }
    bool differentials = strcmp(argv[3], "differentials") == 0;
    run_case *run = differentials                     ? run_differentials
                    : strcmp(argv[3], "hostile") == 0 ? run_both
                                                      : run_intersect;
    size_t words_in = differentials ? DIFFERENTIALS_IN : INTERSECT_IN;
    size_t words_out = differentials ? DIFFERENTIALS_OUT : INTERSECT_OUT;

    FILE *input = open_or_fail(argv[1], "rb");
    FILE *output = open_or_fail(argv[2], "wb");
    float in[INTERSECT_IN];
    while (read_record(input, argv[1], in, words_in)) {
        uint32_t out[DIFFERENTIALS_OUT] = {0};
        run(in, out);
        write_record(output, argv[2], out, words_out);
    }
    if (fclose(output) != 0)
        fail(argv[2], "cannot be written");
    fclose(input);
    return 0;
}
