/* test_selection.c - one light out of many. */
#include "lights/selection.h"

#include "sampling/random.h"
#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

enum { COUNT = 6 };

/* Of grey flux, in W: its luminance is the same number. */
static void make_lights(struct light lights[COUNT])
{
    static const float flux[COUNT] = {10.0f, 0.0f, 30.0f, 1e-6f, 60.0f, 0.0f};
    for (int i = 0; i < COUNT; i++) {
        struct light light = {.kind = LIGHT_POINT, .flux = rgb_grey(flux[i])};
        lights[i] = light;
    }
}

static struct light_table table(bool by_power)
{
    struct light lights[COUNT];
    make_lights(lights);
    return light_table_make(lights, COUNT, by_power, 10.0f);
}

static void probabilities_sum_to_one(void)
{
    for (int by_power = 0; by_power < 2; by_power++) {
        struct light_table t = table(by_power);
        double sum = 0.0;
        for (uint32_t i = 0; i < COUNT; i++)
            sum += (double)light_table_probability(&t, i);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, 1.0, sum);
        light_table_free(&t);
    }
}

static void uniform_is_even(void)
{
    struct light_table t = table(false);
    for (uint32_t i = 0; i < COUNT; i++)
        TEST_ASSERT_FLOAT_WITHIN(1e-6f, 1.0f / COUNT,
                                 light_table_probability(&t, i));
    light_table_free(&t);
}

static void by_power_follows_the_power(void)
{
    struct light_table t = table(true);
    TEST_ASSERT_FLOAT_WITHIN(1e-3f, 0.1f, light_table_probability(&t, 0));
    TEST_ASSERT_FLOAT_WITHIN(1e-3f, 0.3f, light_table_probability(&t, 2));
    TEST_ASSERT_FLOAT_WITHIN(1e-3f, 0.6f, light_table_probability(&t, 4));
    light_table_free(&t);
}

/* A hundred-millionth of the power, but it must be picked now and then. */
static void a_faint_light_is_not_forgotten(void)
{
    struct light_table t = table(true);
    TEST_ASSERT_TRUE(light_table_probability(&t, 3) > 1e-5f);
    TEST_ASSERT_TRUE(light_table_probability(&t, 3) < 1e-2f);
    light_table_free(&t);
}

static void without_power_nothing_is_picked(void)
{
    struct light_table t = table(true);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, light_table_probability(&t, 1));
    TEST_ASSERT_EQUAL_FLOAT(0.0f, light_table_probability(&t, 5));
    light_table_free(&t);
}

static void picks_match_their_probability(void)
{
    enum { STEPS = 1 << 20 };
    for (int by_power = 0; by_power < 2; by_power++) {
        struct light_table t = table(by_power);
        int counted[COUNT] = {0};
        for (int i = 0; i < STEPS; i++) {
            float probability, random = (float)i / (float)STEPS;
            uint32_t light = light_table_pick(&t, random, &probability);
            TEST_ASSERT_EQUAL_FLOAT(light_table_probability(&t, light),
                                    probability);
            TEST_ASSERT_TRUE(probability > 0.0f);
            counted[light]++;
        }
        for (uint32_t i = 0; i < COUNT; i++)
            TEST_ASSERT_FLOAT_WITHIN(2.0f / STEPS,
                                     light_table_probability(&t, i),
                                     (float)counted[i] / STEPS);
        light_table_free(&t);
    }
}

static void all_dark_is_even(void)
{
    struct light lights[2] = {{.kind = LIGHT_POINT}, {.kind = LIGHT_POINT}};
    struct light_table t = light_table_make(lights, 2, true, 1.0f);
    TEST_ASSERT_EQUAL_FLOAT(0.5f, light_table_probability(&t, 0));
    TEST_ASSERT_EQUAL_FLOAT(0.5f, light_table_probability(&t, 1));
    light_table_free(&t);
}

static void no_lights_make_an_empty_table(void)
{
    struct light_table t = light_table_make(NULL, 0, true, 1.0f);
    TEST_ASSERT_EQUAL_UINT32(0, t.count);
    light_table_free(&t);
}

/* The mean over picks of (light's flux / probability) is all the flux. */
static void one_of_many_stands_for_all(void)
{
    enum { STEPS = 1 << 18 };
    struct light lights[COUNT];
    make_lights(lights);
    for (int by_power = 0; by_power < 2; by_power++) {
        struct light_table t = table(by_power);
        double sum = 0.0;
        for (int i = 0; i < STEPS; i++) {
            float probability, random = ((float)i + 0.5f) / (float)STEPS;
            uint32_t light = light_table_pick(&t, random, &probability);
            sum += (double)(lights[light].flux.r / probability);
        }
        TEST_ASSERT_DOUBLE_WITHIN(0.01, 100.0, sum / STEPS);
        light_table_free(&t);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(probabilities_sum_to_one);
    RUN_TEST(uniform_is_even);
    RUN_TEST(by_power_follows_the_power);
    RUN_TEST(a_faint_light_is_not_forgotten);
    RUN_TEST(without_power_nothing_is_picked);
    RUN_TEST(picks_match_their_probability);
    RUN_TEST(all_dark_is_even);
    RUN_TEST(no_lights_make_an_empty_table);
    RUN_TEST(one_of_many_stands_for_all);
    return UNITY_END();
}
