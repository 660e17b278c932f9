/* test_area_light.c - the public tests of assignment 08.
 *
 * The lamp, two by one metre, hangs two metres high and shines down:
 *
 *      z
 *      |   ________________  z = 2       rect.center   (0, 0, 2)
 *      |  /_______________/              rect.side_x   (2, 0, 0)
 *      |         |                       rect.side_y   (0, -1, 0)
 *      |         v normal                rect.normal   (0, 0, -1)
 *      |                                 rect.area     2
 *      +------------------- x
 *
 * Read a test's name and its message; the contract is in lights/rect_light.h.
 * These tests are few: what they leave out is left to you to think of. */
#include "lights/rect_light.h"

#include "sampling/random.h"
#include "unity.h"

static const struct rect LAMP = {{0.0f, 0.0f, 2.0f},
                                 {2.0f, 0.0f, 0.0f},
                                 {0.0f, -1.0f, 0.0f},
                                 {0.0f, 0.0f, -1.0f},
                                 2.0f};

/* Sides that are not at right angles, in the plane x = 3. */
static const struct rect SKEW = {{3.0f, 1.0f, 1.0f},
                                 {0.0f, 4.0f, 0.0f},
                                 {0.0f, 3.0f, 2.0f},
                                 {1.0f, 0.0f, 0.0f},
                                 8.0f};

void setUp(void)
{
}

void tearDown(void)
{
}

static vec2 numbers(int i)
{
    uint64_t key = random_key(8, 0, (uint64_t)i);
    return vec2_make(random_float(key, 0), random_float(key, 1));
}

/* ---- places ---- */

static void places_are_on_the_lamp(void)
{
    for (int i = 0; i < 1000; i++) {
        vec3 p = rect_light_place(&LAMP, numbers(i));
        TEST_ASSERT_FLOAT_WITHIN_MESSAGE(1e-5f, 2.0f, p.z,
                                         "the lamp lies in the plane z = 2");
        TEST_ASSERT_FLOAT_WITHIN_MESSAGE(1.00001f, 0.0f, p.x,
                                         "the lamp ends at x = -1 and x = 1");
        TEST_ASSERT_FLOAT_WITHIN_MESSAGE(0.50001f, 0.0f, p.y,
                                         "the lamp ends at y = -1/2 and 1/2");
    }
}

/* Of 8000 places, 2000 are expected in each quarter, give or take 39: 250 is
 * more than six times that. */
static void each_quarter_gets_its_share(void)
{
    int counts[4] = {0};
    for (int i = 0; i < 8000; i++) {
        vec3 p = rect_light_place(&LAMP, numbers(i));
        counts[(p.x > 0.0f) + 2 * (p.y > 0.0f)]++;
    }
    for (int i = 0; i < 4; i++)
        TEST_ASSERT_INT_WITHIN_MESSAGE(
            250, 2000, counts[i],
            "of 8000 places each quarter of the lamp gets about 2000");
}

static void places_reach_the_edges(void)
{
    float least = 9.0f, most = -9.0f;
    for (int i = 0; i < 2000; i++) {
        vec3 p = rect_light_place(&LAMP, numbers(i));
        least = fminf(least, p.x);
        most = fmaxf(most, p.x);
    }
    TEST_ASSERT_TRUE_MESSAGE(least < -0.95f, "none of 2000 near x = -1");
    TEST_ASSERT_TRUE_MESSAGE(most > 0.95f, "none of 2000 near x = 1");
}

static void the_same_numbers_give_the_same_place(void)
{
    vec3 once = rect_light_place(&LAMP, numbers(1));
    rect_light_place(&LAMP, numbers(2));
    vec3 again = rect_light_place(&LAMP, numbers(1));
    TEST_ASSERT_EQUAL_FLOAT_MESSAGE(once.x, again.x, "random decides alone");
    TEST_ASSERT_EQUAL_FLOAT_MESSAGE(once.y, again.y, "random decides alone");
}

/* In coordinates along its two sides a place of the skewed light is within
 * 1/2 of the centre. */
static void sides_need_not_be_at_right_angles(void)
{
    for (int i = 0; i < 1000; i++) {
        vec3 p = rect_light_place(&SKEW, numbers(i));
        float along_y = (p.z - SKEW.center.z) / 2.0f;
        float along_x = (p.y - SKEW.center.y - 3.0f * along_y) / 4.0f;
        TEST_ASSERT_FLOAT_WITHIN_MESSAGE(1e-5f, 3.0f, p.x, "its plane");
        TEST_ASSERT_FLOAT_WITHIN_MESSAGE(0.50001f, 0.0f, along_y, "side_y");
        TEST_ASSERT_FLOAT_WITHIN_MESSAGE(0.50001f, 0.0f, along_x, "side_x");
    }
}

/* ---- density ---- */

static float pdf_at(float x, float y, float z)
{
    return area_light_pdf(vec3_make(x, y, z), LAMP.center, LAMP.normal,
                          LAMP.area);
}

static void a_far_lamp_covers_few_directions(void)
{
    float near = pdf_at(0.0f, 0.0f, 1.0f), far = pdf_at(0.0f, 0.0f, -8.0f);
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(
        1e-3f, 100.0f, far / near,
        "from ten times as far the lamp covers a hundredth of the directions, "
        "so each must be picked a hundred times as densely");
}

static void a_large_lamp_covers_many_directions(void)
{
    vec3 below = vec3_make(0.0f, 0.0f, 0.0f);
    float small = area_light_pdf(below, LAMP.center, LAMP.normal, 2.0f);
    float large = area_light_pdf(below, LAMP.center, LAMP.normal, 6.0f);
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(
        1e-4f, 1.0f / 3.0f, large / small,
        "three times the area: each direction is picked a third as densely");
}

/* The lamp seen from 1000 m below is nearly a point: its directions fill area /
 * distance^2 steradians, and each is as likely. */
static void far_away_it_is_one_over_the_solid_angle(void)
{
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(
        1.0f, 500000.0f, pdf_at(0.0f, 0.0f, -998.0f),
        "1000 m below 2 m^2: the solid angle is 2e-6 steradians");
}

static void behind_it_nothing_is_seen(void)
{
    TEST_ASSERT_EQUAL_FLOAT_MESSAGE(0.0f, pdf_at(0.3f, 0.2f, 3.0f),
                                    "(0.3, 0.2, 3) is above the lamp, which "
                                    "shines down: 0");
    TEST_ASSERT_EQUAL_FLOAT_MESSAGE(0.0f, pdf_at(5.0f, 0.0f, 2.0f),
                                    "(5, 0, 2) is in the lamp's plane: 0");
    TEST_ASSERT_EQUAL_FLOAT_MESSAGE(0.0f, pdf_at(0.0f, 0.0f, 2.0f),
                                    "the place itself: 0");
}

/* ---- emission ---- */

static void expect_color(rgb want, vec3 outgoing, const char *why)
{
    rgb got =
        area_light_emitted(rgb_make(3.0f, 2.0f, 1.0f), LAMP.normal, outgoing);
    TEST_ASSERT_EQUAL_FLOAT_MESSAGE(want.r, got.r, why);
    TEST_ASSERT_EQUAL_FLOAT_MESSAGE(want.g, got.g, why);
    TEST_ASSERT_EQUAL_FLOAT_MESSAGE(want.b, got.b, why);
}

static void it_shines_downwards(void)
{
    rgb light = rgb_make(3.0f, 2.0f, 1.0f);
    expect_color(light, vec3_make(0.0f, 0.0f, -1.0f), "straight down");
    expect_color(light, vec3_make(0.6f, 0.0f, -0.8f),
                 "the same in all "
                 "directions");
    expect_color(light, vec3_make(0.0f, 0.0f, -7.0f),
                 "the length of outgoing changes nothing");
}

static void it_is_dark_above(void)
{
    rgb black = rgb_grey(0.0f);
    expect_color(black, vec3_make(0.0f, 0.0f, 1.0f), "the back is dark");
    expect_color(black, vec3_make(0.6f, 0.0f, 0.8f), "the back is dark");
    expect_color(black, vec3_make(1.0f, 0.0f, 0.0f),
                 "along the surface nothing leaves it");
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(places_are_on_the_lamp);
    RUN_TEST(each_quarter_gets_its_share);
    RUN_TEST(places_reach_the_edges);
    RUN_TEST(the_same_numbers_give_the_same_place);
    RUN_TEST(sides_need_not_be_at_right_angles);
    RUN_TEST(a_far_lamp_covers_few_directions);
    RUN_TEST(a_large_lamp_covers_many_directions);
    RUN_TEST(far_away_it_is_one_over_the_solid_angle);
    RUN_TEST(behind_it_nothing_is_seen);
    RUN_TEST(it_shines_downwards);
    RUN_TEST(it_is_dark_above);
    return UNITY_END();
}
