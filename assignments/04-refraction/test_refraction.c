/* test_refraction.c - public tests of assignment 04, first part.
 *
 * The boundary is the plane z = 0 and its outside is above:
 *
 *        normal    outgoing          All directions point away from the
 *           |     /                  surface, the one that you are given and
 *           |    /                   the one that you give back: the light
 *   outside |   /                    comes in along `incoming` reversed.
 *   ________|__/________
 *           . |                      sine of the angle with the normal, times
 *   inside  . |                      the index on that side: the same on both
 *           .|                       sides.
 *         incoming
 *
 * Read a test's name and its message; the contract is in
 * materials/refraction.h. */
#include "materials/refraction.h"

#include "unity.h"

static const vec3 UP = {0.0f, 0.0f, 1.0f};

/* Glass in air. */
static const float GLASS = 1.5f;

/* 60 degrees from the normal in air, and 35.26 in glass:
 * sin 60 = 1.5 sin 35.26. */
static const float SINE_IN_AIR = 0.8660254f, COSINE_IN_AIR = 0.5f;
static const float SINE_IN_GLASS = 0.5773503f, COSINE_IN_GLASS = 0.8164966f;

void setUp(void)
{
}

void tearDown(void)
{
}

/* NaN: a component that is never written is never right. */
static const vec3 UNSET = {NAN, NAN, NAN};

static void expect_direction(vec3 want, vec3 got, const char *why)
{
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(2e-6f, want.x, got.x, why);
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(2e-6f, want.y, got.y, why);
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(2e-6f, want.z, got.z, why);
}

static void expect_through(vec3 outgoing, float eta, vec3 want, const char *why)
{
    vec3 incoming = UNSET;
    TEST_ASSERT_TRUE_MESSAGE(refraction_direction(UP, outgoing, eta, &incoming),
                             why);
    expect_direction(want, incoming, why);
}

static void expect_mirrored(vec3 outgoing, float eta, vec3 want,
                            const char *why)
{
    vec3 incoming = UNSET;
    TEST_ASSERT_FALSE_MESSAGE(
        refraction_direction(UP, outgoing, eta, &incoming), why);
    expect_direction(want, incoming, why);
}

static void straight_on_goes_straight_through(void)
{
    expect_through(vec3_make(0, 0, 1), GLASS, vec3_make(0, 0, -1),
                   "seen from above, the light comes from below");
    expect_through(vec3_make(0, 0, -1), GLASS, vec3_make(0, 0, 1),
                   "seen from below, the light comes from above");
}

static void outside_the_angle_is_larger(void)
{
    expect_through(vec3_make(SINE_IN_AIR, 0, COSINE_IN_AIR), GLASS,
                   vec3_make(-SINE_IN_GLASS, 0, -COSINE_IN_GLASS),
                   "outgoing is in air, 60 degrees from the normal: the light "
                   "comes from 35.26 degrees in the glass");
}

static void inside_the_angle_is_smaller(void)
{
    expect_through(vec3_make(SINE_IN_GLASS, 0, -COSINE_IN_GLASS), GLASS,
                   vec3_make(-SINE_IN_AIR, 0, COSINE_IN_AIR),
                   "outgoing is in glass, 35.26 degrees from the normal: the "
                   "light comes from 60 degrees in the air");
}

static void equal_indices_bend_nothing(void)
{
    expect_through(vec3_make(0.6f, 0, 0.8f), 1.0f, vec3_make(-0.6f, 0, -0.8f),
                   "an index of 1: straight through");
    expect_through(vec3_make(0, 0.6f, -0.8f), 1.0f, vec3_make(0, -0.6f, 0.8f),
                   "an index of 1, from the inside: straight through");
}

static void flat_in_glass_light_is_mirrored(void)
{
    expect_mirrored(vec3_make(0.8f, 0, -0.6f), GLASS,
                    vec3_make(-0.8f, 0, -0.6f),
                    "a sine of 0.8 in glass would be one of 1.2 in air: total "
                    "internal reflection, and both directions are inside");
}

static void flat_in_air_light_still_enters(void)
{
    expect_through(vec3_make(0.9999f, 0, 0.014141782f), GLASS,
                   vec3_make(-0.6666f, 0, -0.7454156f),
                   "from the outside light always finds a way into glass");
}

static void the_plane_of_the_two_directions_is_kept(void)
{
    expect_through(vec3_make(0.6f * SINE_IN_AIR, 0.8f * SINE_IN_AIR, 0.5f),
                   GLASS,
                   vec3_make(-0.6f * SINE_IN_GLASS, -0.8f * SINE_IN_GLASS,
                             -COSINE_IN_GLASS),
                   "incoming lies in the plane of outgoing and the normal");
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(straight_on_goes_straight_through);
    RUN_TEST(outside_the_angle_is_larger);
    RUN_TEST(inside_the_angle_is_smaller);
    RUN_TEST(equal_indices_bend_nothing);
    RUN_TEST(flat_in_glass_light_is_mirrored);
    RUN_TEST(flat_in_air_light_still_enters);
    RUN_TEST(the_plane_of_the_two_directions_is_kept);
    return UNITY_END();
}
