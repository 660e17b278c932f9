/* sampler.h - the random numbers of one image sample, in order of use. */
#ifndef RAYBOOK_SAMPLING_SAMPLER_H
#define RAYBOOK_SAMPLING_SAMPLER_H

#include <stdint.h>

#include "base/vec.h"
#include "sampling/random.h"

/* A cheap value: make one a sample, on the stack. Reading a number moves on to
 * the next dimension. */
struct sampler {
    uint64_t key;
    uint32_t dimension;
};

static inline struct sampler sampler_start(uint64_t seed, uint64_t pixel,
                                           uint64_t sample)
{
    struct sampler s = {random_key(seed, pixel, sample), 0};
    return s;
}

/* Uniform in [0, 1). */
static inline float sampler_1d(struct sampler *s)
{
    return random_float(s->key, s->dimension++);
}

/* Uniform in [0, 1) x [0, 1). */
static inline vec2 sampler_2d(struct sampler *s)
{
    float x = sampler_1d(s);
    float y = sampler_1d(s);
    return vec2_make(x, y);
}

#endif
