/* test_delta_lights.c - point, directional and spot. */
#include "lights/delta_lights.h"

#include "base/constants.h"
#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static const vec2 random_numbers = {0.3f, 0.7f};

static struct light point_light(void)
{
    struct light light = {.kind = LIGHT_POINT,
                          .position = {1.0f, 2.0f, 3.0f},
                          .flux = {100.0f, 50.0f, 0.0f}};
    return light;
}

/* At the origin, shining along +x, whole within 20 degrees, dark from 40. */
static struct light spot_light(void)
{
    struct light light = {.kind = LIGHT_SPOT,
                          .direction = {1.0f, 0.0f, 0.0f},
                          .intensity = {10.0f, 20.0f, 30.0f},
                          .beam_angle = PI / 9.0f,
                          .cutoff_angle = 2.0f * PI / 9.0f};
    return light;
}

static void expect_vector(vec3 want, vec3 got)
{
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, want.x, got.x);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, want.y, got.y);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, want.z, got.z);
}

/* How bright it is, assignment 05 says: here is where it is. */
static void a_point_light_is_one_direction(void)
{
    struct light light = point_light();
    struct light_sample s;
    vec3 point = vec3_make(1.0f, 2.0f, -1.0f); /* 4 metres below */
    TEST_ASSERT_TRUE(light_sample(&light, point, random_numbers, &s));
    TEST_ASSERT_FLOAT_WITHIN(1e-6f * s.radiance.r, 0.5f * s.radiance.r,
                             s.radiance.g);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, s.radiance.b);
    expect_vector(vec3_make(0.0f, 0.0f, 1.0f), s.direction);
    expect_vector(light.position, s.target);
    TEST_ASSERT_TRUE(s.delta && !s.infinite);
    TEST_ASSERT_EQUAL_FLOAT(1.0f, s.pdf);
}

static void a_point_at_the_light_sees_nothing(void)
{
    struct light light = point_light(), spot = spot_light();
    struct light_sample s;
    TEST_ASSERT_FALSE(light_sample(&light, light.position, random_numbers, &s));
    TEST_ASSERT_FALSE(light_sample(&spot, spot.position, random_numbers, &s));
}

static void a_directional_light_is_the_same_everywhere(void)
{
    struct light light = {.kind = LIGHT_DIRECTIONAL,
                          .direction = {0.0f, -0.6f, 0.8f},
                          .irradiance = {1.0f, 2.0f, 3.0f}};
    for (int i = 0; i < 3; i++) {
        struct light_sample s;
        vec3 point = vec3_make(100.0f * (float)i, 0.0f, -7.0f);
        TEST_ASSERT_TRUE(light_sample(&light, point, random_numbers, &s));
        expect_vector(vec3_make(0.0f, 0.6f, -0.8f), s.direction);
        TEST_ASSERT_EQUAL_FLOAT(3.0f, s.radiance.b);
        TEST_ASSERT_TRUE(s.delta && s.infinite);
    }
}

/* On the axis, 2 metres in front: whole; the same distance behind: nothing. */
static void a_spot_shines_along_its_direction(void)
{
    struct light light = spot_light();
    struct light_sample s;
    TEST_ASSERT_TRUE(
        light_sample(&light, vec3_make(2, 0, 0), random_numbers, &s));
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 2.5f, s.radiance.r);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 7.5f, s.radiance.b);
    expect_vector(vec3_make(-1.0f, 0.0f, 0.0f), s.direction);
    TEST_ASSERT_FALSE(
        light_sample(&light, vec3_make(-2, 0, 0), random_numbers, &s));
    TEST_ASSERT_FALSE(
        light_sample(&light, vec3_make(0, 2, 0), random_numbers, &s));
}

/* No step at either edge, and halfway down at half the angle between. */
static void a_spot_falls_off_evenly(void)
{
    struct light light = spot_light();
    float last = spot_light_falloff(&light, 1.0f), steepest = 0.0f;
    float step = 1e-4f, width = light.cutoff_angle - light.beam_angle;
    TEST_ASSERT_EQUAL_FLOAT(1.0f, last);
    for (float angle = 0.0f; angle < 1.0f; angle += step) {
        float now = spot_light_falloff(&light, cosf(angle));
        TEST_ASSERT_TRUE(now <= last + 1e-5f && now >= 0.0f);
        steepest = fmaxf(steepest, last - now);
        last = now;
    }
    TEST_ASSERT_EQUAL_FLOAT(0.0f, last);
    TEST_ASSERT_FLOAT_WITHIN(0.05f, 1.0f, steepest * width / step);
    float halfway = 0.5f * (light.beam_angle + light.cutoff_angle);
    TEST_ASSERT_FLOAT_WITHIN(1e-5f, 0.5f,
                             spot_light_falloff(&light, cosf(halfway)));
}

static void a_spot_may_have_a_hard_edge(void)
{
    struct light light = spot_light();
    light.cutoff_angle = light.beam_angle;
    TEST_ASSERT_EQUAL_FLOAT(
        1.0f, spot_light_falloff(&light, cosf(light.beam_angle - 1e-3f)));
    TEST_ASSERT_EQUAL_FLOAT(
        0.0f, spot_light_falloff(&light, cosf(light.beam_angle + 1e-3f)));
}

/* All of a spot's light: the intensity summed over rings around its axis. */
static void a_spots_power_is_its_intensity_over_the_sphere(void)
{
    struct light light = spot_light();
    double sum = 0.0, step = 1e-5;
    for (double c = 1.0 - 0.5 * step; c > 0.0; c -= step)
        sum += (double)spot_light_falloff(&light, (float)c) * step;
    double want =
        2.0 * acos(-1.0) * sum * (double)rgb_luminance(light.intensity);
    TEST_ASSERT_DOUBLE_WITHIN(1e-3 * want, want,
                              (double)light_power(&light, 5.0f));
}

static void power_of_the_others(void)
{
    struct light light = point_light();
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, rgb_luminance(light.flux),
                             light_power(&light, 5.0f));
    struct light sun = {.kind = LIGHT_DIRECTIONAL,
                        .irradiance = {1.0f, 1.0f, 1.0f}};
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, PI * 25.0f, light_power(&sun, 5.0f));
}

static void no_density_and_nothing_to_hit(void)
{
    struct light lights[3] = {point_light(), spot_light(), spot_light()};
    lights[2].kind = LIGHT_DIRECTIONAL;
    vec3 x = vec3_make(1.0f, 0.0f, 0.0f);
    for (int i = 0; i < 3; i++) {
        TEST_ASSERT_TRUE(light_is_delta(&lights[i]));
        TEST_ASSERT_EQUAL_FLOAT(0.0f, light_pdf(&lights[i], x, x, x, x));
        TEST_ASSERT_TRUE(rgb_is_black(light_emitted(&lights[i], x, x)));
    }
}

static void a_light_without_power_is_never_picked(void)
{
    struct light light = point_light();
    struct light_sample s;
    light.flux = rgb_grey(0.0f);
    TEST_ASSERT_FALSE(
        light_sample(&light, vec3_make(0, 0, 0), random_numbers, &s));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(a_point_light_is_one_direction);
    RUN_TEST(a_point_at_the_light_sees_nothing);
    RUN_TEST(a_directional_light_is_the_same_everywhere);
    RUN_TEST(a_spot_shines_along_its_direction);
    RUN_TEST(a_spot_falls_off_evenly);
    RUN_TEST(a_spot_may_have_a_hard_edge);
    RUN_TEST(a_spots_power_is_its_intensity_over_the_sphere);
    RUN_TEST(power_of_the_others);
    RUN_TEST(no_density_and_nothing_to_hit);
    RUN_TEST(a_light_without_power_is_never_picked);
    return UNITY_END();
}
