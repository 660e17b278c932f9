/* sampler.c - see sampler.h. */
#include "sampling/sampler.h"

#include <math.h>
#include <stddef.h>

#include "sampling/scramble.h"

const char *const sampler_names[] = {"independent", "stratified", "sobol",
                                     NULL};

//> sampler.start: Begin a sample
struct sampler sampler_start(enum sampler_kind kind, uint64_t seed,
                             uint64_t pixel, uint32_t sample, uint32_t spp)
{
    struct sampler s;
    s.kind = sample < spp ? kind : SAMPLER_INDEPENDENT;
    s.sample = sample;
    s.spp = spp;
    s.pixel_key = random_pixel_key(seed, pixel);
    s.key = random_key(seed, pixel, sample);
    s.dimension = 0;
    return s;
}
//< sampler.start

//> sampler.independent: Independent numbers
static float independent(struct sampler *s)
{
    return random_float(s->key, s->dimension++);
}
//< sampler.independent

//> sampler.stratified: One number in each stratum
/* A hash that all samples of the pixel share, one for each dimension. */
static uint32_t dimension_hash(const struct sampler *s)
{
    return random_bits(s->pixel_key, s->dimension);
}

static float below_one(float x)
{
    return x < 1.0f ? x : 1.0f - 0x1p-24f;
}

/* Stratum i of n, and a random place in it. */
static float in_stratum(uint32_t i, uint32_t n, float jitter)
{
    return below_one(((float)i + jitter) / (float)n);
}

static float stratified_1d(struct sampler *s)
{
    uint32_t i = scramble_permute(s->sample, s->spp, dimension_hash(s));
    return in_stratum(i, s->spp, independent(s));
}

/* The largest divisor of n that is at most its root: columns x rows = n. */
static uint32_t grid_columns(uint32_t n)
{
    uint32_t columns = (uint32_t)sqrtf((float)n);
    while (columns > 1 && n % columns != 0)
        columns--;
    return columns > 0 ? columns : 1;
}

static vec2 stratified_2d(struct sampler *s)
{
    uint32_t columns = grid_columns(s->spp), rows = s->spp / columns;
    uint32_t i = scramble_permute(s->sample, s->spp, dimension_hash(s));
    float x = in_stratum(i % columns, columns, independent(s));
    float y = in_stratum(i / columns, rows, independent(s));
    return vec2_make(x, y);
}
//< sampler.stratified

//> sampler.sobol: A point of a scrambled net
/* The first two dimensions of Sobol's sequence are a (0,2)-sequence: any
 * power of two consecutive points is evenly spread. The order is shuffled, so
 * that pairs of different dimensions are not related. */
static vec2 sobol_2d(struct sampler *s)
{
    uint32_t hash = dimension_hash(s);
    uint32_t i = scramble_owen(s->sample, hash);
    uint32_t x = scramble_reverse_bits(i), y = scramble_sobol_second(i);
    s->dimension += 2;
    return vec2_make(scramble_to_float(scramble_owen(x, hash ^ 0x55555555u)),
                     scramble_to_float(scramble_owen(y, hash ^ 0xaaaaaaaau)));
}
//< sampler.sobol

//> sampler.read: Read the next number or pair
float sampler_1d(struct sampler *s)
{
    switch (s->kind) {
    case SAMPLER_STRATIFIED:
        return stratified_1d(s);
    case SAMPLER_SOBOL: {
        vec2 point = sobol_2d(s);
        s->dimension--;
        return point.x;
    }
    case SAMPLER_INDEPENDENT:
        break;
    }
    return independent(s);
}

vec2 sampler_2d(struct sampler *s)
{
    switch (s->kind) {
    case SAMPLER_STRATIFIED:
        return stratified_2d(s);
    case SAMPLER_SOBOL:
        return sobol_2d(s);
    case SAMPLER_INDEPENDENT:
        break;
    }
    float x = independent(s);
    float y = independent(s);
    return vec2_make(x, y);
}
//< sampler.read
