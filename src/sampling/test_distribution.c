/* test_distribution.c - picking by weight. */
#include "sampling/distribution.h"

#include "sampling/test_density.h"
#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static void probabilities_are_shares_of_the_weights(void)
{
    const float weights[] = {1.0f, 0.0f, 2.0f, 5.0f};
    struct distribution_1d d = distribution_1d_make(weights, 4);
    TEST_ASSERT_DOUBLE_WITHIN(0.0, 8.0, d.total);
    for (uint32_t i = 0; i < 4; i++)
        TEST_ASSERT_FLOAT_WITHIN(1e-7f, weights[i] / 8.0f,
                                 distribution_1d_probability(&d, i));
    distribution_1d_free(&d);
}

/* Sweeping the number over all of [0, 1) makes each cell's share exact. */
static void a_sweep_picks_each_cell_by_its_share(void)
{
    const float weights[] = {0.0f, 3.0f, 0.0f, 1.0f, 4.0f, 0.0f, 0.0f};
    struct distribution_1d d = distribution_1d_make(weights, 7);
    int counted[7] = {0}, steps = 1 << 16;
    for (int i = 0; i < steps; i++) {
        float remainder;
        counted[distribution_1d_sample(&d, (float)i / (float)steps,
                                       &remainder)]++;
        TEST_ASSERT_TRUE(remainder >= 0.0f && remainder < 1.0f);
    }
    for (int i = 0; i < 7; i++)
        TEST_ASSERT_EQUAL_INT((int)(weights[i] / 8.0f * (float)steps),
                              counted[i]);
    distribution_1d_free(&d);
}

/* Where in its cell the number fell runs evenly from 0 to 1. */
static void the_remainder_is_a_fresh_number(void)
{
    const float weights[] = {3.0f, 5.0f};
    struct distribution_1d d = distribution_1d_make(weights, 2);
    float remainder;
    TEST_ASSERT_EQUAL_UINT32(0, distribution_1d_sample(&d, 0.0f, &remainder));
    TEST_ASSERT_EQUAL_FLOAT(0.0f, remainder);
    TEST_ASSERT_EQUAL_UINT32(0,
                             distribution_1d_sample(&d, 0.1875f, &remainder));
    TEST_ASSERT_EQUAL_FLOAT(0.5f, remainder);
    TEST_ASSERT_EQUAL_UINT32(1, distribution_1d_sample(&d, 0.375f, &remainder));
    TEST_ASSERT_EQUAL_FLOAT(0.0f, remainder);
    TEST_ASSERT_EQUAL_UINT32(1, distribution_1d_sample(&d, 0.84375f, NULL));
    distribution_1d_free(&d);
}

static void the_ends_of_the_range_never_pick_weight_zero(void)
{
    const float weights[] = {0.0f, 0.0f, 1e-9f, 1e9f, 0.1f, 0.0f};
    struct distribution_1d d = distribution_1d_make(weights, 6);
    TEST_ASSERT_EQUAL_UINT32(2, distribution_1d_sample(&d, 0.0f, NULL));
    uint32_t last = distribution_1d_sample(&d, 1.0f - 0x1p-24f, NULL);
    TEST_ASSERT_TRUE(last == 3 || last == 4);
    distribution_1d_free(&d);
}

static void all_zero_is_even(void)
{
    const float weights[4] = {0.0f};
    struct distribution_1d d = distribution_1d_make(weights, 4);
    TEST_ASSERT_DOUBLE_WITHIN(0.0, 0.0, d.total);
    for (uint32_t i = 0; i < 4; i++)
        TEST_ASSERT_EQUAL_FLOAT(0.25f, distribution_1d_probability(&d, i));
    TEST_ASSERT_EQUAL_UINT32(3, distribution_1d_sample(&d, 0.9f, NULL));
    distribution_1d_free(&d);
}

/* The last cell that begins at or before the number: by trying them all. */
static uint32_t plain_search(const struct distribution_1d *d, float random)
{
    uint32_t cell = 0;
    while (cell + 1 < d->count && d->cdf[cell + 1] <= (double)random)
        cell++;
    return cell;
}

static void check_around(const struct distribution_1d *d, float x)
{
    const float tries[] = {nextafterf(x, 0.0f), x, nextafterf(x, 1.0f)};
    for (int i = 0; i < 3; i++)
        if (tries[i] < 1.0f)
            TEST_ASSERT_EQUAL_UINT32(plain_search(d, tries[i]),
                                     distribution_1d_sample(d, tries[i], NULL));
}

/* Weights of very different sizes, a third of them 0. The numbers to try lie at
 * the borders of the parts and of the cells, and beside them. */
static void the_guide_finds_what_a_plain_search_finds(void)
{
    float weights[70];
    for (uint32_t count = 1; count <= 70; count++) {
        for (uint32_t i = 0; i < count; i++) {
            float x = random_float(count, i);
            weights[i] = x < 0.33f ? 0.0f : x < 0.66f ? x : 1e4f * x;
        }
        struct distribution_1d d = distribution_1d_make(weights, count);
        for (uint32_t i = 0; i <= d.parts; i++)
            check_around(&d, (float)i / (float)d.parts);
        for (uint32_t i = 0; i < count; i++)
            check_around(&d, (float)d.cdf[i]);
        distribution_1d_free(&d);
    }
}

/* A float table would give the dark cells after the sun 0 or twice their
 * share. */
static void dark_cells_beside_a_sun_keep_their_share(void)
{
    enum { COUNT = 4096 };
    static float weights[COUNT];
    for (int i = 0; i < COUNT; i++)
        weights[i] = 1.0f;
    weights[100] = 1e9f;
    struct distribution_1d d = distribution_1d_make(weights, COUNT);
    for (uint32_t i = 101; i < COUNT; i++)
        TEST_ASSERT_FLOAT_WITHIN(
            1e-5f, 1.0f, distribution_1d_probability(&d, i) * (1e9f + COUNT));
    distribution_1d_free(&d);
}

static void huge_weights_do_not_overflow(void)
{
    const float weights[] = {3e38f, 3e38f, 3e38f, 3e38f};
    struct distribution_2d d = distribution_2d_make(weights, 2, 2);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 1.0f,
                             distribution_2d_pdf(&d, vec2_make(0.2f, 0.9f)));
    distribution_2d_free(&d);
}

static bool pick_point(const void *context, vec2 random, vec3 *point)
{
    const struct distribution_2d *d = context;
    vec2 p;
    float density = distribution_2d_sample(d, random, &p);
    TEST_ASSERT_TRUE(p.x >= 0.0f && p.x < 1.0f && p.y >= 0.0f && p.y < 1.0f);
    TEST_ASSERT_EQUAL_FLOAT(distribution_2d_pdf(d, p), density);
    *point = vec3_make(p.x, p.y, 0.0f);
    return true;
}

static double point_pdf(const void *context, vec3 p)
{
    return distribution_2d_pdf(context, vec2_make(p.x, p.y));
}

static void points_of_the_square_follow_the_density(void)
{
    const float weights[] = {1, 0, 7, 2, 0, 0, 0, 0, 4, 1, 1, 9};
    struct distribution_2d d = distribution_2d_make(weights, 4, 3);
    struct density_test test = {.context = &d,
                                .sample = pick_point,
                                .pdf = point_pdf,
                                .upper = vec2_make(1.0f, 1.0f),
                                .rows = 12,
                                .columns = 16,
                                .subdivisions = 1,
                                .samples = 200000};
    struct density_result r = density_compare(&test);
    TEST_ASSERT_EQUAL_INT(0, r.outside);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 1.0, r.integral);
    TEST_ASSERT_TRUE(r.chi_squared < r.limit);
    distribution_2d_free(&d);
}

/* 1000 cells are no power of two: coordinates round, but not out of a cell. */
static void rounding_stays_in_the_cell(void)
{
    static float weights[1000 * 3];
    for (int i = 0; i < 3000; i++)
        weights[i] = i % 2 == 0 ? 1.0f : 1e-3f;
    struct distribution_2d d = distribution_2d_make(weights, 1000, 3);
    for (int i = 0; i < 100000; i++) {
        uint64_t key = random_key(7, 0, (uint64_t)i);
        vec3 point;
        pick_point(&d, vec2_make(random_float(key, 0), random_float(key, 1)),
                   &point);
    }
    distribution_2d_free(&d);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(probabilities_are_shares_of_the_weights);
    RUN_TEST(a_sweep_picks_each_cell_by_its_share);
    RUN_TEST(the_remainder_is_a_fresh_number);
    RUN_TEST(the_ends_of_the_range_never_pick_weight_zero);
    RUN_TEST(all_zero_is_even);
    RUN_TEST(the_guide_finds_what_a_plain_search_finds);
    RUN_TEST(dark_cells_beside_a_sun_keep_their_share);
    RUN_TEST(huge_weights_do_not_overflow);
    RUN_TEST(points_of_the_square_follow_the_density);
    RUN_TEST(rounding_stays_in_the_cell);
    return UNITY_END();
}
