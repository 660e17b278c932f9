/* probe_aabb.c - runs a box module on many cases; judges nothing.
 *
 *   probe INPUT OUTPUT GROUP
 *
 * Both files are arrays of records of 32-bit little-endian words (f = IEEE
 * single, u = unsigned); OUTPUT has one record for each of INPUT, in order.
 * oracle_aabb.py mirrors this layout. GROUP makes no difference.
 *
 *   in   14 f   lower, upper, origin, direction (x y z each), t_min, t_max
 *   out   4     u returned true (1) or false (0), f t_enter, f t_exit, u flags
 *
 * A function that returned false has zeros for its results.
 * Flags: 1 = changed the ray or the box; 2 = returned true, yet left one of
 * its results as it was. */
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "accel/aabb.h"

enum { CHANGED_INPUT = 1, NOT_WRITTEN = 2 };
enum { WORDS_IN = 14, WORDS_OUT = 4 };

/* What results hold before the call: no case has this for an answer. */
static const float UNTOUCHED = -12345.6787f;

static void fail(const char *file, const char *what)
{
    fprintf(stderr, "probe_aabb: %s: %s\n", file, what);
    exit(2);
}

static uint32_t word_of(float value)
{
    uint32_t word;
    memcpy(&word, &value, sizeof word);
    return word;
}

static vec3 take_vec3(const float *in)
{
    return vec3_make(in[0], in[1], in[2]);
}

static void run(const float *in, uint32_t *out)
{
    const aabb box = {take_vec3(in), take_vec3(in + 3)};
    const ray given =
        ray_make(take_vec3(in + 6), take_vec3(in + 9), in[12], in[13]);
    aabb used_box = box;
    ray used = given;
    float t_enter = UNTOUCHED, t_exit = UNTOUCHED;
    if (aabb_intersect(&used_box, &used, &t_enter, &t_exit)) {
        out[0] = 1;
        out[1] = word_of(t_enter);
        out[2] = word_of(t_exit);
        if (out[1] == word_of(UNTOUCHED) || out[2] == word_of(UNTOUCHED))
            out[3] |= NOT_WRITTEN;
    }
    if (memcmp(&used, &given, sizeof used) != 0 ||
        memcmp(&used_box, &box, sizeof box) != 0)
        out[3] |= CHANGED_INPUT;
}

/* The next record; false at the end of the file. */
static bool read_record(FILE *file, const char *name, float *record)
{
    unsigned char bytes[4 * WORDS_IN];
    size_t got = fread(bytes, 1, sizeof bytes, file);
    if (ferror(file))
        fail(name, "cannot be read");
    if (got == 0)
        return false;
    if (got != sizeof bytes)
        fail(name, "ends inside a record; expected whole records of cases");
    for (size_t i = 0; i < WORDS_IN; i++) {
        const unsigned char *b = bytes + 4 * i;
        uint32_t word = (uint32_t)b[0] | (uint32_t)b[1] << 8 |
                        (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
        memcpy(&record[i], &word, sizeof word);
    }
    return true;
}

static void write_record(FILE *file, const char *name, const uint32_t *record)
{
    unsigned char bytes[4 * WORDS_OUT];
    for (size_t i = 0; i < sizeof bytes; i++)
        bytes[i] = (unsigned char)(record[i / 4] >> (8 * (i % 4)));
    if (fwrite(bytes, 1, sizeof bytes, file) != sizeof bytes)
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
        fprintf(stderr, "usage: probe_aabb INPUT OUTPUT GROUP\n");
        return 2;
    }
    FILE *input = open_or_fail(argv[1], "rb");
    FILE *output = open_or_fail(argv[2], "wb");
    float in[WORDS_IN];
    while (read_record(input, argv[1], in)) {
        uint32_t out[WORDS_OUT] = {0};
        run(in, out);
        write_record(output, argv[2], out);
    }
    if (fclose(output) != 0)
        fail(argv[2], "cannot be written");
    fclose(input);
    return 0;
}
