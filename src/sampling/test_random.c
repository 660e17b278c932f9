/* test_random.c - tests of random.h and sampler.h.
 *
 * Chi-squared tests of uniformity: N numbers in 1024 cells, so 1023 degrees of
 * freedom. A perfect generator fails one test of them in 5 million: it exceeds
 * 1280 (too uneven) or stays below 800 (too even) with a probability below
 * 1e-7 each. The keys are fixed, so a test that passes goes on passing. */
#include "sampling/random.h"

#include <math.h>
#include <string.h>

#include "sampling/sampler.h"

#include "unity.h"

enum { NUMBERS = 1 << 20, CELLS = 1024, SIDE = 32 };

static uint32_t cells[CELLS];

void setUp(void)
{
    memset(cells, 0, sizeof cells);
}

void tearDown(void)
{
}

static void count(float x)
{
    TEST_ASSERT_TRUE_MESSAGE(x >= 0.0f && x < 1.0f, "range [0, 1)");
    cells[(int)(x * CELLS)]++;
}

static void count_pair(float x, float y)
{
    cells[(int)(x * SIDE) * SIDE + (int)(y * SIDE)]++;
}

static void expect_uniform(void)
{
    double chi2 = 0.0, expected = (double)NUMBERS / CELLS;
    for (int i = 0; i < CELLS; i++)
        chi2 += (cells[i] - expected) * (cells[i] - expected) / expected;
    TEST_ASSERT_TRUE_MESSAGE(chi2 < 1280.0, "too uneven for chance");
    TEST_ASSERT_TRUE_MESSAGE(chi2 > 800.0, "too even for chance");
}

static void one_stream_is_uniform(void)
{
    uint64_t key = random_key(0, 0, 0);
    for (uint32_t i = 0; i < NUMBERS; i++)
        count(random_float(key, i));
    expect_uniform();
}

static void the_first_number_is_uniform_over_samples(void)
{
    for (uint64_t i = 0; i < NUMBERS; i++)
        count(random_float(random_key(0, 7, i), 0));
    expect_uniform();
}

static void the_first_number_is_uniform_over_pixels(void)
{
    for (uint64_t i = 0; i < NUMBERS; i++)
        count(random_float(random_key(0, i, 0), 0));
    expect_uniform();
}

static void the_first_number_is_uniform_over_seeds(void)
{
    for (uint64_t i = 0; i < NUMBERS; i++)
        count(random_float(random_key(i, 0, 0), 0));
    expect_uniform();
}

static void pairs_of_a_sample_are_uniform(void)
{
    for (uint64_t i = 0; i < NUMBERS; i++) {
        uint64_t key = random_key(1, 3, i);
        count_pair(random_float(key, 0), random_float(key, 1));
    }
    expect_uniform();
}

static void neighbouring_pixels_are_independent(void)
{
    for (uint64_t i = 0; i < NUMBERS; i++)
        count_pair(random_float(random_key(0, 2 * i, 0), 0),
                   random_float(random_key(0, 2 * i + 1, 0), 0));
    expect_uniform();
}

static void neighbouring_samples_are_independent(void)
{
    for (uint64_t i = 0; i < NUMBERS; i++)
        count_pair(random_float(random_key(0, 0, 2 * i), 5),
                   random_float(random_key(0, 0, 2 * i + 1), 5));
    expect_uniform();
}

static void neighbouring_seeds_are_independent(void)
{
    for (uint64_t i = 0; i < NUMBERS; i++)
        count_pair(random_float(random_key(41, i, 0), 0),
                   random_float(random_key(42, i, 0), 0));
    expect_uniform();
}

/* (pixel 1, sample 2) and (pixel 2, sample 1) must not share a stream, and
 * neither may one key's later numbers be another key's first ones. */
static void no_two_keys_coincide(void)
{
    for (uint64_t a = 0; a < 64; a++)
        for (uint64_t b = 0; b < 64; b++) {
            TEST_ASSERT_TRUE(random_key(0, a, b) != random_key(0, b, a) ||
                             a == b);
            TEST_ASSERT_TRUE(random_key(a, b, 0) != random_key(b, a, 0) ||
                             a == b);
            TEST_ASSERT_TRUE(random_key(0, a, b) != random_key(1, a, b));
        }
}

static void the_same_key_gives_the_same_number(void)
{
    for (uint32_t i = 0; i < 1000; i++)
        TEST_ASSERT_TRUE(random_float(random_key(5, i, 9), i) ==
                         random_float(random_key(5, i, 9), i));
}

/* Each input bit changes each output bit in half of all cases: 4096 words, so
 * a standard deviation of 32; seven of them are met by chance with
 * probability 1e-8 in all 4096 pairs of bits. */
static void every_bit_depends_on_every_bit(void)
{
    for (int in = 0; in < 64; in++) {
        int flips[64] = {0};
        for (uint64_t word = 0; word < 4096; word++) {
            uint64_t z = random_mix(word * 77) ^
                         random_mix((word * 77) ^ (UINT64_C(1) << in));
            for (int out = 0; out < 64; out++)
                flips[out] += (int)(z >> out & 1);
        }
        for (int out = 0; out < 64; out++)
            TEST_ASSERT_INT_WITHIN(7 * 32, 2048, flips[out]);
    }
}

/* 2^24 steps: the largest float below one is 1 - 2^-24. */
static void numbers_have_24_bits(void)
{
    float most = 0.0f;
    uint64_t key = random_key(0, 0, 0);
    for (uint32_t i = 0; i < NUMBERS; i++) {
        float x = random_float(key, i);
        TEST_ASSERT_TRUE(x * 0x1p24f == floorf(x * 0x1p24f));
        most = fmaxf(most, x);
    }
    TEST_ASSERT_TRUE(most > 1.0f - 1e-5f);
}

static void a_sampler_walks_through_the_dimensions(void)
{
    struct sampler s = sampler_start(SAMPLER_INDEPENDENT, 3, 4, 5, 1);
    uint64_t key = random_key(3, 4, 5);
    TEST_ASSERT_TRUE(sampler_1d(&s) == random_float(key, 0));
    vec2 pair = sampler_2d(&s);
    TEST_ASSERT_TRUE(pair.x == random_float(key, 1));
    TEST_ASSERT_TRUE(pair.y == random_float(key, 2));
    TEST_ASSERT_TRUE(sampler_1d(&s) == random_float(key, 3));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(one_stream_is_uniform);
    RUN_TEST(the_first_number_is_uniform_over_samples);
    RUN_TEST(the_first_number_is_uniform_over_pixels);
    RUN_TEST(the_first_number_is_uniform_over_seeds);
    RUN_TEST(pairs_of_a_sample_are_uniform);
    RUN_TEST(neighbouring_pixels_are_independent);
    RUN_TEST(neighbouring_samples_are_independent);
    RUN_TEST(neighbouring_seeds_are_independent);
    RUN_TEST(no_two_keys_coincide);
    RUN_TEST(the_same_key_gives_the_same_number);
    RUN_TEST(every_bit_depends_on_every_bit);
    RUN_TEST(numbers_have_24_bits);
    RUN_TEST(a_sampler_walks_through_the_dimensions);
    return UNITY_END();
}
