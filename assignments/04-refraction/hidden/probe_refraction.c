/* probe_refraction.c - runs refraction_direction on many cases; judges nothing.
 *
 *   probe INPUT OUTPUT GROUP
 *
 * Both files are arrays of records of 32-bit little-endian words (f = IEEE
 * single, u = unsigned); OUTPUT has one record for each of INPUT, in order.
 * oracle_refraction.py mirrors this layout. GROUP is not looked at.
 *
 *   in    7 f   normal, outgoing, eta_inside_over_outside
 *   out   4     u returned true (1) or false (0), 3 f incoming
 *
 * incoming is three NaNs before each call. */
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "materials/refraction.h"

enum { WORDS_IN = 7, WORDS_OUT = 4 };

static void fail(const char *file, const char *what)
{
    fprintf(stderr, "probe_refraction: %s: %s\n", file, what);
    exit(2);
}

static void run(const float *in, uint32_t *out)
{
    vec3 incoming = {NAN, NAN, NAN};
    out[0] =
        refraction_direction(vec3_make(in[0], in[1], in[2]),
                             vec3_make(in[3], in[4], in[5]), in[6], &incoming);
    memcpy(&out[1], &incoming.x, 4);
    memcpy(&out[2], &incoming.y, 4);
    memcpy(&out[3], &incoming.z, 4);
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
        fprintf(stderr, "usage: probe_refraction INPUT OUTPUT GROUP\n");
        return 2;
    }
    FILE *input = open_or_fail(argv[1], "rb");
    FILE *output = open_or_fail(argv[2], "wb");
    float in[WORDS_IN];
    while (read_record(input, argv[1], in)) {
        uint32_t out[WORDS_OUT];
        run(in, out);
        write_record(output, argv[2], out);
    }
    if (fclose(output) != 0)
        fail(argv[2], "cannot be written");
    fclose(input);
    return 0;
}
