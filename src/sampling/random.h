/* random.h - random numbers by counting.
 *
 * A counter-based generator has no state that runs along: number k of a
 * stream is a hash of (key, k). Any pixel's samples can be made alone, in any
 * order, on any thread, and are always the same. */
#ifndef RAYBOOK_SAMPLING_RANDOM_H
#define RAYBOOK_SAMPLING_RANDOM_H

#include <stdint.h>

/* A bijection of 64-bit numbers in which each input bit changes each output
 * bit with probability near one half: D. Stafford's "Mix13" constants, as in
 * G. Steele, D. Lea, C. Flood, "Fast Splittable Pseudorandom Number
 * Generators", OOPSLA 2014, section 3. */
static inline uint64_t random_mix(uint64_t z)
{
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return z ^ (z >> 31);
}

/* The key that all samples of a pixel share. */
static inline uint64_t random_pixel_key(uint64_t seed, uint64_t pixel)
{
    uint64_t key = random_mix(seed + UINT64_C(0x9e3779b97f4a7c15));
    return random_mix(key ^ (pixel + UINT64_C(0xd1b54a32d192ed03)));
}

/* The key of one sample's stream. */
static inline uint64_t random_key(uint64_t seed, uint64_t pixel,
                                  uint64_t sample)
{
    uint64_t key = random_pixel_key(seed, pixel);
    return random_mix(key ^ (sample + UINT64_C(0x8cb92ba72f3d8dd7)));
}

/* 32 random bits: number `dimension` of the stream. */
static inline uint32_t random_bits(uint64_t key, uint32_t dimension)
{
    uint64_t step = UINT64_C(0x9e3779b97f4a7c15) * (dimension + UINT64_C(1));
    return (uint32_t)(random_mix(key + step) >> 32);
}

/* Number `dimension` of the stream: uniform in [0, 1), a multiple of 2^-24,
 * so that 1 is never reached by rounding. */
static inline float random_float(uint64_t key, uint32_t dimension)
{
    return (float)(random_bits(key, dimension) >> 8) * 0x1p-24f;
}

#endif
