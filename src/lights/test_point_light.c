/* test_point_light.c - tests of point_light.h. */
#include "lights/point_light.h"

#include "base/constants.h"

#include "unity.h"

static const struct point_light light = {{1, 2, 3}, {100, 50, 0}};

void setUp(void)
{
}

void tearDown(void)
{
}

static void irradiance_falls_with_the_square(void)
{
    for (float d = 1e-3f; d < 2e4f; d *= 10) {
        vec3 to_light;
        const struct point_light at_origin = {{0, 0, 0}, {100, 50, 0}};
        rgb e =
            point_light_irradiance(&at_origin, vec3_make(0, -d, 0), &to_light);
        float want = 100 / (4 * PI * d * d);
        TEST_ASSERT_FLOAT_WITHIN(1e-6f * want, want, e.r);
        TEST_ASSERT_FLOAT_WITHIN(1e-6f * want, want / 2, e.g);
        TEST_ASSERT_EQUAL_FLOAT(0, e.b);
        TEST_ASSERT_FLOAT_WITHIN(1e-6f, 1, to_light.y);
    }
}

static void the_direction_points_to_the_light(void)
{
    vec3 d;
    rgb e = point_light_irradiance(&light, vec3_make(1, -1, 7), &d);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0, d.x);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.6f, d.y);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, -0.8f, d.z);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 1 / PI, e.r); /* 100 / (4 pi 25) */
}

static void at_the_light_there_is_none(void)
{
    vec3 d = {7, 7, 7};
    rgb e = point_light_irradiance(&light, light.position, &d);
    TEST_ASSERT_TRUE(rgb_is_black(e));
    TEST_ASSERT_EQUAL_FLOAT(1, vec3_length(d));
}

/* What passes through a closed surface around the light is its flux: the
 * irradiance times the cosine, over the six sides of a cube. Midpoint rule. */
static void all_of_the_flux_arrives(void)
{
    const int n = 200;
    double power = 0.0;
    for (int i = 0; i < n; i++)
        for (int k = 0; k < n; k++) {
            vec3 d;
            float u = ((float)i + 0.5f) / (float)n - 0.5f;
            float v = ((float)k + 0.5f) / (float)n - 0.5f;
            const struct point_light centre = {{0, 0, 0}, {100, 50, 0}};
            rgb e = point_light_irradiance(&centre, vec3_make(u, v, 0.5f), &d);
            power += (double)(-d.z * e.r);
        }
    TEST_ASSERT_FLOAT_WITHIN(1e-2f, 100, (float)(6 * power / (n * n)));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(irradiance_falls_with_the_square);
    RUN_TEST(the_direction_points_to_the_light);
    RUN_TEST(at_the_light_there_is_none);
    RUN_TEST(all_of_the_flux_arrives);
    return UNITY_END();
}
