/* test_sampler.c - the samplers: range, strata, and what they gain. */
#include "sampling/sampler.h"

#include "sampling/scramble.h"
#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static void permutations_are_bijections(void)
{
    static unsigned char seen[1000];
    for (uint32_t count = 1; count <= 1000; count += count < 20 ? 1 : 97) {
        for (uint32_t i = 0; i < count; i++)
            seen[i] = 0;
        for (uint32_t i = 0; i < count; i++) {
            uint32_t to = scramble_permute(i, count, 12345u * count);
            TEST_ASSERT_TRUE(to < count);
            TEST_ASSERT_EQUAL_UINT8(0, seen[to]);
            seen[to] = 1;
        }
    }
}

/* Column by column: each is the one before, xor itself shifted by one bit. */
static uint32_t sobol_second_by_columns(uint32_t i)
{
    uint32_t x = 0;
    for (uint32_t column = 1u << 31; i != 0; i >>= 1) {
        x ^= i & 1 ? column : 0;
        column ^= column >> 1;
    }
    return x;
}

/* The map is linear: what holds for each bit alone holds for all numbers. */
static void the_second_sobol_dimension_is_pascals(void)
{
    for (int bit = 0; bit < 32; bit++) {
        uint32_t i = UINT32_C(1) << bit;
        TEST_ASSERT_EQUAL_HEX32(sobol_second_by_columns(i),
                                scramble_sobol_second(i));
    }
    for (uint32_t k = 0; k < 10000; k++) {
        uint32_t i = random_bits(11, k);
        TEST_ASSERT_EQUAL_HEX32(sobol_second_by_columns(i),
                                scramble_sobol_second(i));
    }
}

/* Of 64 stratified samples, each of the 8 x 8 cells holds one, in every pair
 * of dimensions; of 64 Sobol samples, also each of the 64 x 1 and 1 x 64. */
static void check_strata(enum sampler_kind kind, uint32_t columns,
                         uint32_t rows)
{
    for (int pair = 0; pair < 4; pair++) {
        uint64_t cells = 0;
        for (uint32_t i = 0; i < 64; i++) {
            struct sampler s = sampler_start(kind, 7, 99, i, 64);
            vec2 p = sampler_2d(&s);
            for (int k = 0; k < pair; k++)
                p = sampler_2d(&s);
            uint32_t x = (uint32_t)(p.x * (float)columns);
            uint32_t y = (uint32_t)(p.y * (float)rows);
            TEST_ASSERT_TRUE(x < columns && y < rows);
            cells |= UINT64_C(1) << (y * columns + x);
        }
        TEST_ASSERT_TRUE(cells == UINT64_MAX);
    }
}

static void every_stratum_has_its_sample(void)
{
    check_strata(SAMPLER_STRATIFIED, 8, 8);
    check_strata(SAMPLER_SOBOL, 8, 8);
    check_strata(SAMPLER_SOBOL, 64, 1);
    check_strata(SAMPLER_SOBOL, 1, 64);
    check_strata(SAMPLER_SOBOL, 4, 16);
}

static void one_dimension_is_stratified_too(void)
{
    for (int kind = SAMPLER_STRATIFIED; kind <= SAMPLER_SOBOL; kind++) {
        uint64_t cells = 0;
        for (uint32_t i = 0; i < 64; i++) {
            struct sampler s =
                sampler_start((enum sampler_kind)kind, 1, 5, i, 64);
            sampler_2d(&s);
            cells |= UINT64_C(1) << (uint32_t)(64.0f * sampler_1d(&s));
        }
        TEST_ASSERT_TRUE(cells == UINT64_MAX);
    }
}

/* The estimate of a smooth integral over two dimensions (1/4 + 1/3 exactly)
 * from 64 samples: mean of many pixels, and their variance. */
static double variance(enum sampler_kind kind)
{
    enum { PIXELS = 2000 };
    double sum = 0.0, squares = 0.0;
    for (uint64_t pixel = 0; pixel < PIXELS; pixel++) {
        double estimate = 0.0;
        for (uint32_t i = 0; i < 64; i++) {
            struct sampler s = sampler_start(kind, 3, pixel, i, 64);
            float z = sampler_1d(&s);
            vec2 p = sampler_2d(&s);
            estimate += (double)(p.x * p.y + z * z) / 64.0;
        }
        sum += estimate;
        squares += estimate * estimate;
    }
    double mean = sum / PIXELS, v = squares / PIXELS - mean * mean;
    /* Six standard errors: false by chance in 2e-9. */
    TEST_ASSERT_DOUBLE_WITHIN(6.0 * sqrt(v / PIXELS) + 1e-6, 7.0 / 12.0, mean);
    return v;
}

/* Measured: 160 and 1500 times less. */
static void even_samplers_gain(void)
{
    double independent = variance(SAMPLER_INDEPENDENT);
    TEST_ASSERT_TRUE(variance(SAMPLER_STRATIFIED) < independent / 50.0);
    TEST_ASSERT_TRUE(variance(SAMPLER_SOBOL) < independent / 300.0);
}

static void samples_beyond_spp_are_still_random(void)
{
    double sum = 0.0;
    for (uint32_t i = 64; i < 10064; i++) {
        struct sampler s = sampler_start(SAMPLER_STRATIFIED, 3, 1, i, 64);
        sum += (double)sampler_1d(&s);
    }
    /* The mean's deviation is sqrt(1/12/10000) = 0.0029. */
    TEST_ASSERT_DOUBLE_WITHIN(0.018, 0.5, sum / 10000);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(permutations_are_bijections);
    RUN_TEST(the_second_sobol_dimension_is_pascals);
    RUN_TEST(every_stratum_has_its_sample);
    RUN_TEST(one_dimension_is_stratified_too);
    RUN_TEST(even_samplers_gain);
    RUN_TEST(samples_beyond_spp_are_still_random);
    return UNITY_END();
}
