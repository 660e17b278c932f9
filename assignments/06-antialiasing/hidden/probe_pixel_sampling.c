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
#include "camera/pixel_sampling.h"
#include "probe.h"

enum { OTHER_ANSWER = 1 };
enum { FILTER_WORDS = 5 };

/* What goes on from record to record. */
struct bench {
    struct pixel_sums sums;
    struct filter filter;
    float made_of[FILTER_WORDS];
};

static void run_value(struct probe *p, struct bench *bench)
{
    rgb radiance = take_rgb(p);
    float weight = take_float(p), what = take_float(p);
    if (what > 0.0f)
        memset(&bench->sums, 0, sizeof bench->sums);
    if (what < 2.0f)
        pixel_add(&bench->sums, radiance, weight);
    put_rgb(p, pixel_value(&bench->sums));
    put_word(p, bench->sums.samples);
}

/* Tables are made when the filter changes, which is not often. */
static void take_filter(struct probe *p, struct bench *bench)
{
    float f[FILTER_WORDS];
    take_floats(p, f, FILTER_WORDS);
    if (memcmp(bench->made_of, f, sizeof f) == 0)
        return;
    memcpy(bench->made_of, f, sizeof f);
    struct film_settings film = {
        1, 1, (enum filter_kind)(int)f[0], f[1], f[2], f[3], f[4]};
    bench->filter = filter_make(&film);
}

/* Another sample is asked for in between: none may be remembered. */
static void run_place(struct probe *p, struct bench *bench)
{
    take_filter(p, bench);
    const struct filter *f = &bench->filter;
    int x = (int)take_float(p), y = (int)take_float(p);
    struct sample_number number;
    number.index = (uint32_t)take_float(p);
    number.count = (uint32_t)take_float(p);
    number.shared = (uint32_t)take_float(p) * 0x9e3779b1u;
    struct sample_number other = {0, number.count, ~number.shared};
    vec2 random = take_vec2(p);
    struct pixel_sample a = pixel_sample(f, x, y, number, random);
    pixel_sample(f, y, x, other, vec2_make(0.5f * random.y, 0.5f * random.x));
    struct pixel_sample b = pixel_sample(f, x, y, number, random);
    put_float(p, a.place.x);
    put_float(p, a.place.y);
    put_float(p, a.weight);
    put_word(p, memcmp(&a, &b, sizeof a) != 0 ? OTHER_ANSWER : 0);
}

int main(int argc, char **argv)
{
    struct probe p = probe_open("probe_pixel_sampling", argc, argv);
    bool value = probe_is(&p, "value");
    static struct bench bench;
    while (probe_more(&p)) {
        if (value)
            run_value(&p, &bench);
        else
            run_place(&p, &bench);
    }
    return probe_close(&p);
}
