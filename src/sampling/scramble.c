/* scramble.c - see scramble.h. */
#include "sampling/scramble.h"

//> scramble.permute: Shuffle without a table
/* Every step is a bijection of the numbers up to mask: xor and odd products
 * modulo a power of two, and xors with shifted-down selves. */
static uint32_t mix_below(uint32_t i, uint32_t mask, uint32_t hash)
{
    for (int round = 0; round < 3; round++) {
        i = (i ^ hash) & mask;
        i = (i * 0x9e3779b1u) & mask;
        i ^= (i & mask) >> 3;
        i = (i * 0x85ebca6bu) & mask;
        i ^= (i & mask) >> 5;
        i = (i + (hash >> 7)) & mask;
        hash = hash * 0xc2b2ae35u + 0x27d4eb2fu;
    }
    return i & mask;
}

uint32_t scramble_permute(uint32_t i, uint32_t count, uint32_t hash)
{
    uint32_t mask = 1;
    while (mask < count - 1)
        mask = 2 * mask + 1;
    do
        i = mix_below(i, mask, hash);
    while (i >= count);
    return (uint32_t)(((uint64_t)i + hash) % count);
}
//< scramble.permute

//> scramble.sobol: The second coordinate of a Sobol point
/* The generator matrix is Pascal's triangle modulo 2, which repeats itself in
 * its halves: with P the triangle of half the size it is
 *
 *     P P
 *     0 P
 *
 * So one half of the bits is added (modulo 2) to the other, and then each half
 * is treated in the same way; all quarters at once, all eighths, and so on. */
uint32_t scramble_sobol_second(uint32_t i)
{
    uint32_t x = scramble_reverse_bits(i);
    x ^= x << 16;
    x ^= (x & 0x00ff00ffu) << 8;
    x ^= (x & 0x0f0f0f0fu) << 4;
    x ^= (x & 0x33333333u) << 2;
    return x ^ (x & 0x55555555u) << 1;
}
//< scramble.sobol

//> scramble.owen: Scramble digit by digit
/* Each bit of the result depends on the bits below it only. */
static uint32_t mix_upwards(uint32_t x, uint32_t hash)
{
    x ^= x * 0x3d20adeau;
    x += hash;
    x *= (hash >> 16) | 1;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

uint32_t scramble_owen(uint32_t fraction, uint32_t hash)
{
    uint32_t mixed = mix_upwards(scramble_reverse_bits(fraction), hash);
    return scramble_reverse_bits(mixed);
}
//< scramble.owen
