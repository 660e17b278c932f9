/* scramble.h - shuffles and scrambles by hash: what the even samplers need. */
#ifndef RAYBOOK_SAMPLING_SCRAMBLE_H
#define RAYBOOK_SAMPLING_SCRAMBLE_H

#include <stdint.h>

/* Where number i of 0 .. count - 1 goes under a permutation picked by the
 * hash. A bijection for every count: a hash on the next power of two is
 * applied again until the number is in range ("cycle walking"), as in
 * A. Kensler, "Correlated Multi-Jittered Sampling", Pixar technical memo
 * 13-01, 2013, section 3. */
uint32_t scramble_permute(uint32_t i, uint32_t count, uint32_t hash);

static inline uint32_t scramble_reverse_bits(uint32_t x)
{
    x = (x >> 16) | (x << 16);
    x = ((x & 0x00ff00ffu) << 8) | ((x & 0xff00ff00u) >> 8);
    x = ((x & 0x0f0f0f0fu) << 4) | ((x & 0xf0f0f0f0u) >> 4);
    x = ((x & 0x33333333u) << 2) | ((x & 0xccccccccu) >> 2);
    return ((x & 0x55555555u) << 1) | ((x & 0xaaaaaaaau) >> 1);
}

/* Point number i of the second dimension of Sobol's sequence, as a fraction
 * of 2^32. The first dimension is scramble_reverse_bits(i). */
uint32_t scramble_sobol_second(uint32_t i);

/* Owen's scrambling (A. Owen, "Randomly Permuted (t,m,s)-Nets and
 * (t,s)-Sequences", 1995) of a fraction of 2^32: each bit is flipped or not
 * depending on all bits above it, and so strata of every size stay filled.
 * Of an index it is a shuffle that keeps each aligned power of two of indices
 * together, so that the first 2^k points of a sequence stay a net.
 * By S. Laine and T. Karras' hash with the constants of N. Vegdahl, as in
 * B. Burley, "Practical Hash-based Owen Scrambling", JCGT 9(4), 2020. */
uint32_t scramble_owen(uint32_t fraction, uint32_t hash);

/* A fraction of 2^32 as a float in [0, 1). */
static inline float scramble_to_float(uint32_t fraction)
{
    return (float)(fraction >> 8) * 0x1p-24f;
}

#endif
