/* sampler.h - the random numbers of one image sample, in order of use.
 *
 * Reading a number moves on to the next dimension; the same dimension of the
 * pixel's other samples belongs together, and the better samplers spread
 * those evenly. Every number depends on (seed, pixel, sample, dimension) only.
 *
 * independent: no relation. stratified: the spp samples of a pixel fall into
 * spp equal strata, one each, in an order shuffled for each dimension (2D: a
 * grid as square as spp allows). sobol: an Owen-scrambled (0,2)-sequence for
 * each dimension or pair, shuffled and scrambled by hash (B. Burley, "Practical
 * Hash-based Owen Scrambling", JCGT 9(4), 2020); best for spp a power of 2. */
#ifndef RAYBOOK_SAMPLING_SAMPLER_H
#define RAYBOOK_SAMPLING_SAMPLER_H

#include <stdint.h>

#include "base/vec.h"
#include "sampling/random.h"

enum sampler_kind { SAMPLER_INDEPENDENT, SAMPLER_STRATIFIED, SAMPLER_SOBOL };

/* NULL-terminated, in the order of enum sampler_kind. */
extern const char *const sampler_names[];

/* A cheap value: make one a sample, on the stack. */
struct sampler {
    enum sampler_kind kind;
    uint32_t sample, spp;
    uint64_t key;       /* of this sample */
    uint64_t pixel_key; /* shared by the pixel's samples */
    uint32_t dimension;
};

/* Sample number `sample` of spp of a pixel (its index on the whole film). A
 * sample number at or above spp is allowed and falls back on independent
 * numbers where the strata are used up. */
struct sampler sampler_start(enum sampler_kind kind, uint64_t seed,
                             uint64_t pixel, uint32_t sample, uint32_t spp);

/* Uniform in [0, 1). */
float sampler_1d(struct sampler *s);

/* Uniform in [0, 1) x [0, 1); takes two dimensions. */
vec2 sampler_2d(struct sampler *s);

#endif
