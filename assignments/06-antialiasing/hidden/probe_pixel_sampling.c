/* probe_pixel_sampling.c - runs a pixel sampling module on many cases; judges
 * nothing.
 *
 *   probe INPUT OUTPUT GROUP
 *
 * Both files are arrays of records of 32-bit little-endian words (IEEE single
 * but for the flags and counts of the output); OUTPUT has one record for each
 * of INPUT, in order. The oracles mirror this layout.
 *
 * GROUP "value":
 *   in    5   radiance (r g b), weight, what: 0 = the pixel's next sample,
 *             1 = the first one of another pixel, 2 = another pixel and no
 *             sample (the other words are ignored)
 *   out   4   pixel_value of the pixel so far (r g b); its `samples`
 * Any other GROUP:
 *   in   12   filter: kind, radius, alpha, B, C; pixel x and y; index, count,
 *             shared (a whole number below 2^24, spread over 32 bits); random
 *             x and y
 *   out   4   place x and y, weight; flags: 1 = the same arguments gave
 *             another answer the second time */
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "camera/pixel_sampling.h"

enum { OTHER_ANSWER = 1 };
enum { VALUE_IN = 5, PLACE_IN = 12, FILTER_IN = 5, WORDS_OUT = 4 };

/* What goes on from record to record. */
struct bench {
    struct pixel_sums sums;
    struct filter filter;
    float made_of[FILTER_IN];
};

typedef void run_case(struct bench *bench, const float *in, uint32_t *out);

static void fail(const char *file, const char *what)
{
    fprintf(stderr, "probe_pixel_sampling: %s: %s\n", file, what);
    exit(2);
}

static void put(uint32_t *out, float value)
{
    memcpy(out, &value, sizeof value);
}

static void run_value(struct bench *bench, const float *in, uint32_t *out)
{
    if (in[4] > 0.0f)
        memset(&bench->sums, 0, sizeof bench->sums);
    if (in[4] < 2.0f)
        pixel_add(&bench->sums, rgb_make(in[0], in[1], in[2]), in[3]);
    rgb value = pixel_value(&bench->sums);
    put(out, value.r);
    put(out + 1, value.g);
    put(out + 2, value.b);
    out[3] = bench->sums.samples;
}

/* Tables are made when the filter changes, which is not often. */
static void set_filter(struct bench *bench, const float *in)
{
    if (memcmp(bench->made_of, in, sizeof bench->made_of) == 0)
        return;
    memcpy(bench->made_of, in, sizeof bench->made_of);
    struct film_settings film = {
        1, 1, (enum filter_kind)(int)in[0], in[1], in[2], in[3], in[4]};
    bench->filter = filter_make(&film);
}

/* Another sample is asked for in between: none may be remembered. */
static void run_place(struct bench *bench, const float *in, uint32_t *out)
{
    set_filter(bench, in);
    const struct filter *f = &bench->filter;
    int x = (int)in[5], y = (int)in[6];
    struct sample_number number = {(uint32_t)in[7], (uint32_t)in[8],
                                   (uint32_t)in[9] * 0x9e3779b1u};
    struct sample_number other = {0, number.count, ~number.shared};
    vec2 random = vec2_make(in[10], in[11]);
    struct pixel_sample a = pixel_sample(f, x, y, number, random);
    pixel_sample(f, y, x, other, vec2_make(0.5f * random.y, 0.5f * random.x));
    struct pixel_sample b = pixel_sample(f, x, y, number, random);
    put(out, a.place.x);
    put(out + 1, a.place.y);
    put(out + 2, a.weight);
    out[3] = memcmp(&a, &b, sizeof a) != 0 ? OTHER_ANSWER : 0;
}

/* The next record of `words` words; false at the end of the file. */
static bool read_record(FILE *file, const char *name, float *record,
                        size_t words)
{
    unsigned char bytes[4 * PLACE_IN];
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

static void write_record(FILE *file, const char *name, const uint32_t *record)
{
    unsigned char bytes[4 * WORDS_OUT];
    for (size_t i = 0; i < 4 * WORDS_OUT; i++)
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
        fprintf(stderr, "usage: probe_pixel_sampling INPUT OUTPUT GROUP\n");
        return 2;
    }
    bool value = strcmp(argv[3], "value") == 0;
    run_case *run = value ? run_value : run_place;

    FILE *input = open_or_fail(argv[1], "rb");
    FILE *output = open_or_fail(argv[2], "wb");
    static struct bench bench;
    float in[PLACE_IN];
    while (read_record(input, argv[1], in, value ? VALUE_IN : PLACE_IN)) {
        uint32_t out[WORDS_OUT] = {0};
        run(&bench, in, out);
        write_record(output, argv[2], out);
    }
    if (fclose(output) != 0)
        fail(argv[2], "cannot be written");
    fclose(input);
    return 0;
}
