/* test_filter.c - reconstruction filters: values, densities, weights. */
#include "camera/filter.h"

#include "sampling/sampler.h"
#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static struct filter make(enum filter_kind kind, float radius)
{
    struct film_settings film = {1,    1,           kind,       radius,
                                 2.0f, 1.0f / 3.0f, 1.0f / 3.0f};
    return filter_make(&film);
}

static const float radii[] = {0.5f, 1.0f, 1.7f, 2.0f, 4.0f};

static void filters_have_their_textbook_values(void)
{
    struct filter box = make(FILTER_BOX, 0.5f), tent = make(FILTER_TENT, 2.0f);
    struct filter gaussian = make(FILTER_GAUSSIAN, 1.5f);
    struct filter mitchell = make(FILTER_MITCHELL, 2.0f);
    TEST_ASSERT_EQUAL_FLOAT(1.0f, filter_value(&box, -0.5f));
    TEST_ASSERT_EQUAL_FLOAT(0.0f, filter_value(&box, 0.51f));
    TEST_ASSERT_EQUAL_FLOAT(0.25f, filter_value(&tent, 1.5f));
    TEST_ASSERT_EQUAL_FLOAT(1.0f - expf(-4.5f), filter_value(&gaussian, 0.0f));
    TEST_ASSERT_FLOAT_WITHIN(1e-7f, 0.0f, filter_value(&gaussian, 1.5f));
    /* Mitchell and Netravali, equation 8, with B = C = 1/3. */
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 8.0f / 9.0f, filter_value(&mitchell, 0.0f));
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 1.0f / 18.0f,
                             filter_value(&mitchell, 1.0f));
    TEST_ASSERT_TRUE(filter_value(&mitchell, 1.5f) < 0.0f);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.0f, filter_value(&mitchell, 2.0f));
}

/* The expected weight is one, and the weighted mean of any g(x) over samples
 * is the integral of f g over that of f: checked on a grid of random numbers
 * for g = cos(1.3 x + 0.4), which is neither even nor odd. */
static void check_against_integral(enum filter_kind kind, float radius)
{
    enum { GRID = 512, STEPS = 20000 };
    struct filter f = make(kind, radius);
    double weights = 0.0, sampled = 0.0, mass = 0.0, integral = 0.0;
    for (int i = 0; i < GRID; i++)
        for (int k = 0; k < 64; k++) {
            vec2 random =
                vec2_make((float)(i + 0.5) / GRID, (float)(k + 0.5) / 64.0f);
            float w;
            vec2 offset = filter_sample(&f, random, &w);
            TEST_ASSERT_TRUE(fabsf(offset.x) <= radius);
            TEST_ASSERT_TRUE(fabsf(offset.y) <= radius);
            weights += (double)w;
            sampled += (double)w * cos(1.3 * (double)offset.x + 0.4);
        }
    for (int i = 0; i < STEPS; i++) {
        double x = (double)radius * (2.0 * (i + 0.5) / STEPS - 1.0);
        double value = (double)filter_value(&f, (float)x);
        mass += value;
        integral += value * cos(1.3 * x + 0.4);
    }
    TEST_ASSERT_DOUBLE_WITHIN(0.02, 1.0, weights / (GRID * 64));
    TEST_ASSERT_DOUBLE_WITHIN(0.005, integral / mass, sampled / weights);
}

static void samples_follow_the_filter(void)
{
    for (int kind = FILTER_BOX; kind <= FILTER_MITCHELL; kind++)
        for (size_t i = 0; i < sizeof radii / sizeof radii[0]; i++)
            check_against_integral((enum filter_kind)kind, radii[i]);
}

static void filters_are_even(void)
{
    for (int kind = FILTER_BOX; kind <= FILTER_MITCHELL; kind++) {
        struct filter f = make((enum filter_kind)kind, 2.0f);
        for (float x = 0.0f; x < 2.5f; x += 0.01f)
            TEST_ASSERT_TRUE(filter_value(&f, x) == filter_value(&f, -x));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(filters_have_their_textbook_values);
    RUN_TEST(samples_follow_the_filter);
    RUN_TEST(filters_are_even);
    return UNITY_END();
}
