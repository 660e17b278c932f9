/* test_vec.c - tests of vec.h: the frame about a normal, and products. */
#include "base/vec.h"

#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

/* What a few roundings do to numbers of size one. */
static const float near_zero = 1e-6f;

static void expect_frame(vec3 n)
{
    vec3 s, t;
    vec3_frame(n, &s, &t);
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(near_zero, 1, vec3_length(s), "|s|");
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(near_zero, 1, vec3_length(t), "|t|");
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(near_zero, 0, vec3_dot(s, t), "s . t");
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(near_zero, 0, vec3_dot(s, n), "s . n");
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(near_zero, 0, vec3_dot(t, n), "t . n");
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(
        near_zero, 1, vec3_dot(vec3_cross(s, t), n), "right-handed");
}

static void frames_are_orthonormal_in_every_direction(void)
{
    for (int i = 0; i <= 200; i++)
        for (int k = 0; k < 200; k++) {
            float theta = 3.14159265f * (float)i / 200.0f;
            float phi = 6.28318531f * (float)k / 200.0f;
            expect_frame(vec3_normalize(vec3_make(sinf(theta) * cosf(phi),
                                                  sinf(theta) * sinf(phi),
                                                  cosf(theta))));
        }
}

static void frames_exist_at_the_poles(void)
{
    expect_frame(vec3_make(0, 0, 1));
    expect_frame(vec3_make(0, 0, -1));
}

/* The older formula divides by 1 + n.z and fails here. */
static void frames_exist_close_to_the_poles(void)
{
    for (float tilt = 1e-20f; tilt < 0.5f; tilt *= 7.0f) {
        expect_frame(vec3_normalize(vec3_make(tilt, -tilt, 1)));
        expect_frame(vec3_normalize(vec3_make(tilt, -tilt, -1)));
        expect_frame(vec3_normalize(vec3_make(-tilt, tilt / 2, -1)));
    }
}

static void frames_exist_on_the_equator(void)
{
    expect_frame(vec3_make(1, 0, 0.0f));
    expect_frame(vec3_make(1, 0, -0.0f));
    expect_frame(vec3_make(0, -1, 0.0f));
    expect_frame(vec3_make(0, -1, -0.0f));
}

static void cross_is_right_handed(void)
{
    vec3 z = vec3_cross(vec3_make(2, 0, 0), vec3_make(0, 3, 0));
    TEST_ASSERT_EQUAL_FLOAT(0, z.x);
    TEST_ASSERT_EQUAL_FLOAT(0, z.y);
    TEST_ASSERT_EQUAL_FLOAT(6, z.z);
}

static void step_goes_along_its_direction(void)
{
    vec3 p = vec3_step(vec3_make(1, 2, 3), 2, vec3_make(10, 20, -30));
    TEST_ASSERT_EQUAL_FLOAT(21, p.x);
    TEST_ASSERT_EQUAL_FLOAT(42, p.y);
    TEST_ASSERT_EQUAL_FLOAT(-57, p.z);
}

static void axes_are_numbered_from_x(void)
{
    vec3 v = vec3_make(4, 5, 6);
    TEST_ASSERT_EQUAL_FLOAT(4, vec3_axis(v, 0));
    TEST_ASSERT_EQUAL_FLOAT(5, vec3_axis(v, 1));
    TEST_ASSERT_EQUAL_FLOAT(6, vec3_axis(v, 2));
}

static void one_bad_component_is_not_finite(void)
{
    TEST_ASSERT_TRUE(vec3_is_finite(vec3_make(0, -3e38f, 1e-40f)));
    TEST_ASSERT_FALSE(vec3_is_finite(vec3_make(NAN, 0, 0)));
    TEST_ASSERT_FALSE(vec3_is_finite(vec3_make(0, INFINITY, 0)));
    TEST_ASSERT_FALSE(vec3_is_finite(vec3_make(0, 0, -INFINITY)));
}

static void expect_same(float expected, float got)
{
    TEST_ASSERT_TRUE(expected == got || (isnan(expected) && isnan(got)));
}

static void smaller_and_larger_are_the_librarys(void)
{
    const float x[] = {NAN,  -INFINITY, -3e38f, -1.0f,   -1e-45f, -0.0f,
                       0.0f, 1e-45f,    1.0f,   1.0001f, 3e38f,   INFINITY};
    for (int i = 0; i < 12; i++)
        for (int k = 0; k < 12; k++) {
            expect_same(fminf(x[i], x[k]), float_min(x[i], x[k]));
            expect_same(fmaxf(x[i], x[k]), float_max(x[i], x[k]));
        }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(frames_are_orthonormal_in_every_direction);
    RUN_TEST(frames_exist_at_the_poles);
    RUN_TEST(frames_exist_close_to_the_poles);
    RUN_TEST(frames_exist_on_the_equator);
    RUN_TEST(cross_is_right_handed);
    RUN_TEST(step_goes_along_its_direction);
    RUN_TEST(axes_are_numbered_from_x);
    RUN_TEST(one_bad_component_is_not_finite);
    RUN_TEST(smaller_and_larger_are_the_librarys);
    return UNITY_END();
}
