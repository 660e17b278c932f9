/* test_transform.c - tests of transform.h. */
#include "base/transform.h"

#include <string.h>

#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static void expect_near(vec3 want, vec3 got, float tolerance, const char *why)
{
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(tolerance, want.x, got.x, why);
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(tolerance, want.y, got.y, why);
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(tolerance, want.z, got.z, why);
}

static struct transform made(const float rows[16])
{
    struct transform t;
    TEST_ASSERT_TRUE(transform_from_rows(rows, &t));
    return t;
}

static void refuse(const float rows[16], const char *why)
{
    struct transform t;
    TEST_ASSERT_FALSE_MESSAGE(transform_from_rows(rows, &t), why);
}

/* Turns x to y, doubles z, moves by (10, 20, 30). */
static const float turn[16] = {0, -1, 0, 10, 1, 0, 0, 20,
                               0, 0,  2, 30, 0, 0, 0, 1};
static const float shear[16] = {1, 3, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
static const float mirror[16] = {-1, 0, 0, 0, 0, 1, 0, 0,
                                 0,  0, 1, 0, 0, 0, 0, 1};

static void identity_changes_nothing(void)
{
    struct transform t = transform_identity();
    vec3 p = vec3_make(1, -2, 3);
    expect_near(p, transform_point(&t, p), 0, "point");
    expect_near(p, transform_direction(&t, p), 0, "direction");
    expect_near(p, transform_normal(&t, p), 0, "normal");
    TEST_ASSERT_FALSE(transform_mirrors(&t));
}

static void points_move_directions_turn(void)
{
    struct transform t = made(turn);
    vec3 v = vec3_make(1, 2, 3);
    expect_near(vec3_make(8, 21, 36), transform_point(&t, v), 0, "point");
    expect_near(vec3_make(-2, 1, 6), transform_direction(&t, v), 0, "");
}

static void rows_act_on_columns(void)
{
    struct transform t = made(shear);
    expect_near(vec3_make(3, 1, 0), transform_point(&t, vec3_make(0, 1, 0)), 0,
                "x' = x + 3 y");
}

/* t->inverse as a map of its own. */
static vec3 back(const struct transform *t, vec3 p)
{
    float rows[16];
    memcpy(rows, t->inverse, sizeof rows);
    struct transform inverse = made(rows);
    return transform_point(&inverse, p);
}

static void the_inverse_undoes(void)
{
    const float general[16] = {2,    0.5f, -1, 4, 0.25f, 3, 1, -7,
                               0.5f, -2,   5,  9, 0,     0, 0, 1};
    struct transform t = made(general);
    vec3 p = vec3_make(1.5f, -2.25f, 3);
    expect_near(p, back(&t, transform_point(&t, p)), 1e-5f, "there and back");
}

static void badly_scaled_maps_keep_their_digits(void)
{
    const float scaled[16] = {1e6f, 0, 0, 1, 0, 1e-6f, 0, 0,
                              0,    0, 1, 0, 0, 0,     0, 1};
    struct transform t = made(scaled);
    TEST_ASSERT_FLOAT_WITHIN(1e-12f, 1e-6f, t.inverse[0][0]);
    TEST_ASSERT_FLOAT_WITHIN(1.0f, 1e6f, t.inverse[1][1]);
    TEST_ASSERT_FLOAT_WITHIN(1e-12f, -1e-6f, t.inverse[0][3]);
}

static void tiny_and_huge_maps_are_fine(void)
{
    for (int k = -15; k <= 15; k++) {
        float s = powf(10, (float)k);
        const float rows[16] = {s, 0, 0, 0, 0, s, 0, 0, 0, 0, s, 0, 0, 0, 0, 1};
        struct transform t = made(rows);
        TEST_ASSERT_FLOAT_WITHIN(1e-6f, 1.0f, t.inverse[1][1] * s);
        TEST_ASSERT_FALSE(transform_mirrors(&t));
    }
}

/* A normal stays at right angles to the surface, which a direction that is
 * moved like a point does not. */
static void normals_stay_at_right_angles(void)
{
    struct transform t = made(shear);
    vec3 along1 = transform_direction(&t, vec3_make(1, -1, 0));
    vec3 along2 = transform_direction(&t, vec3_make(0, 0, 1));
    vec3 n = transform_normal(&t, vec3_make(1, 1, 0));
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0, vec3_dot(n, along1));
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0, vec3_dot(n, along2));
    TEST_ASSERT_TRUE(vec3_length(n) > 0.1f);
}

static void normals_do_not_move_with_the_translation(void)
{
    struct transform t = made(turn);
    expect_near(vec3_make(0, 0, 0.5f), transform_normal(&t, vec3_make(0, 0, 1)),
                1e-6f, "z is doubled, so its normal is halved");
}

static void mirrors_are_known(void)
{
    struct transform t = made(mirror);
    TEST_ASSERT_TRUE(transform_mirrors(&t));
    t = made(turn);
    TEST_ASSERT_FALSE(transform_mirrors(&t));
    const float three[16] = {-1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1};
    t = made(three);
    TEST_ASSERT_TRUE_MESSAGE(transform_mirrors(&t), "three mirrors are one");
}

static void translated_comes_second(void)
{
    struct transform t = transform_translated(made(turn), vec3_make(1, 1, -30));
    expect_near(vec3_make(9, 22, 6), transform_point(&t, vec3_make(1, 2, 3)), 0,
                "turned first, then moved");
    expect_near(vec3_make(1, 2, 3), back(&t, vec3_make(9, 22, 6)), 1e-5f,
                "the inverse follows");
}

static void flat_maps_are_refused(void)
{
    const float zero[16] = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1};
    const float onto_plane[16] = {1, 0, 0, 0, 0, 1, 0, 0,
                                  0, 0, 0, 0, 0, 0, 0, 1};
    const float rank_two[16] = {1, 2, 3, 0, 4, 5, 6, 0, 7, 8, 9, 0, 0, 0, 0, 1};
    refuse(zero, "all zero");
    refuse(onto_plane, "z is lost");
    refuse(rank_two, "the rows depend on each other");
}

/* The second row is twice the first to the last digit; what does not cancel
 * in the determinant is rounding. */
static void flat_maps_with_crooked_numbers_are_refused(void)
{
    const float rows[16] = {0.1f, 0.3f, 0.7f,  0, 0.2f, 0.6f, 1.4f, 0,
                            0.9f, 1.1f, 0.13f, 0, 0,    0,    0,    1};
    const float more[16] = {0.37f, 1.91f, 0.73f, 0, 0.9f, 0.7f, 0.11f, 0,
                            1.11f, 5.73f, 2.19f, 0, 0,    0,    0,     1};
    float triple[16];
    refuse(rows, "row 2 is twice row 1");
    for (int i = 0; i < 16; i++)
        triple[i] = more[i];
    for (int i = 0; i < 3; i++)
        triple[8 + i] = 4.0f * more[i];
    refuse(triple, "row 3 is four times row 1");
}

static void only_affine_maps_are_accepted(void)
{
    for (int i = 12; i < 16; i++) {
        float rows[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
        rows[i] += 0.5f;
        refuse(rows, "the last row must be 0 0 0 1");
    }
}

static void numbers_that_are_not_finite_are_refused(void)
{
    for (int i = 0; i < 12; i++) {
        float rows[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
        rows[i] = NAN;
        refuse(rows, "NaN");
        rows[i] = INFINITY;
        refuse(rows, "infinity");
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(identity_changes_nothing);
    RUN_TEST(points_move_directions_turn);
    RUN_TEST(rows_act_on_columns);
    RUN_TEST(the_inverse_undoes);
    RUN_TEST(badly_scaled_maps_keep_their_digits);
    RUN_TEST(tiny_and_huge_maps_are_fine);
    RUN_TEST(normals_stay_at_right_angles);
    RUN_TEST(normals_do_not_move_with_the_translation);
    RUN_TEST(mirrors_are_known);
    RUN_TEST(translated_comes_second);
    RUN_TEST(flat_maps_are_refused);
    RUN_TEST(flat_maps_with_crooked_numbers_are_refused);
    RUN_TEST(only_affine_maps_are_accepted);
    RUN_TEST(numbers_that_are_not_finite_are_refused);
    return UNITY_END();
}
