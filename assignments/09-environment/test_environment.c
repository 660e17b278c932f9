/* test_environment.c - the public tests of assignment 09.
 *
 * Most use a map of 8 x 4 texels that is black but for one:
 *
 *          u = 0                                  1
 *       v = 0 +----+----+----+----+----+----+----+----+  +z
 *             |    | ** |    |    |    |    |    |    |
 *             +----+----+----+----+----+----+----+----+
 *             |    |    |    |    |    |    |    |    |
 *             +----+----+----+----+----+----+----+----+  the horizon
 *
 * A direction is told by the place in the map that it belongs to, in texels:
 * texel (1, 0) has its centre at (1.5, 0.5). Read a test's name and its
 * message; the contract is in lights/environment.h. These tests are few: what
 * they leave out is left to you to think of. */
#include "lights/environment_map.h"

#include "base/constants.h"
#include "sampling/random.h"
#include "unity.h"

static struct image image;
static struct environment environment;

void setUp(void)
{
}

void tearDown(void)
{
    environment_free(&environment);
    image_free(&image);
}

static struct transform turn_by(const float rows[16])
{
    struct transform t;
    TEST_ASSERT_TRUE(transform_from_rows(rows, &t));
    return t;
}

/* Black but for one texel of (1, 2, 4); tearDown releases it. */
static void make_spot(int x, int y, float scale, struct transform to_world)
{
    image = image_make(8, 4);
    image.pixels[y * 8 + x] = rgb_make(1.0f, 2.0f, 4.0f);
    environment = environment_make(&image, scale, to_world);
}

static void make_even(float value)
{
    image = image_make(8, 4);
    for (int i = 0; i < 32; i++)
        image.pixels[i] = rgb_grey(value);
    environment = environment_make(&image, 1.0f, transform_identity());
}

/* The direction of a place in a map of 8 x 4 texels. */
static vec3 direction_at(float x, float y)
{
    float phi = 2.0f * PI * x / 8.0f, theta = PI * y / 4.0f;
    return vec3_make(sinf(theta) * cosf(phi), sinf(theta) * sinf(phi),
                     cosf(theta));
}

static void expect_green(float want, vec3 direction, const char *why)
{
    rgb got = environment_radiance(&environment, direction);
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(1e-3f, want, got.g, why);
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(1e-3f, 0.5f * want, got.r, why);
}

static vec2 numbers(int i)
{
    uint64_t key = random_key(9, 0, (uint64_t)i);
    return vec2_make(random_float(key, 0), random_float(key, 1));
}

/* ---- radiance ---- */

static void a_texel_is_seen_at_its_centre(void)
{
    make_spot(1, 0, 1.0f, transform_identity());
    expect_green(2.0f, direction_at(1.5f, 0.5f), "the centre of texel (1, 0)");
    expect_green(0.0f, direction_at(1.5f, 3.5f), "far below it");
    expect_green(0.0f, direction_at(6.5f, 0.5f), "its mirror image");
    expect_green(0.0f, direction_at(5.5f, 0.5f), "the other side");
}

static void scale_multiplies(void)
{
    make_spot(1, 0, 10.0f, transform_identity());
    expect_green(20.0f, direction_at(1.5f, 0.5f), "scale is 10");
}

static void between_centres_neighbours_blend(void)
{
    make_spot(4, 2, 1.0f, transform_identity());
    expect_green(1.5f, direction_at(4.25f, 2.5f),
                 "a quarter texel to the left");
    expect_green(1.0f, direction_at(4.5f, 3.0f), "half a texel below");
    expect_green(0.5f, direction_at(5.0f, 2.0f), "the corner of four texels");
    expect_green(0.0f, direction_at(5.5f, 2.5f), "the next texel's centre");
}

static void the_last_column_meets_the_first(void)
{
    make_spot(7, 2, 1.0f, transform_identity());
    expect_green(1.0f, direction_at(8.0f, 2.5f), "x = 8, where the map closes");
    expect_green(0.5f, direction_at(0.25f, 2.5f),
                 "x = 0.25: a quarter of its light reaches the first column");
}

static void the_map_turns_with_its_light(void)
{
    /* Local +x goes to world +y: a quarter turn about +z. */
    static const float rows[16] = {0, -1, 0, 0, 1, 0, 0, 0,
                                   0, 0,  1, 0, 0, 0, 0, 1};
    make_spot(1, 1, 1.0f, turn_by(rows));
    expect_green(2.0f, direction_at(3.5f, 1.5f),
                 "a quarter turn moves texel (1, 1) to where (3, 1) was");
    expect_green(0.0f, direction_at(7.5f, 1.5f), "the other way round");
}

/* ---- density and picks ---- */

static void a_pick_has_one_density(void)
{
    make_spot(1, 1, 1.0f, transform_identity());
    for (int i = 0; i < 200; i++) {
        vec3 d;
        float density = environment_sample(&environment, numbers(i), &d);
        float again = environment_pdf(&environment, d);
        TEST_ASSERT_TRUE_MESSAGE(density > 0.0f, "there is light to be picked");
        TEST_ASSERT_FLOAT_WITHIN_MESSAGE(1e-5f, 1.0f, vec3_length(d),
                                         "directions are of length one");
        TEST_ASSERT_FLOAT_WITHIN_MESSAGE(
            0.01f * density, density, again,
            "environment_sample and environment_pdf disagree on a direction");
    }
}

/* The mean of 1 / density over picks is what they cover, here all of the
 * sphere. A density that is off by a factor is found out; one that is uneven
 * only makes the mean less sure. */
static void an_even_sky_covers_the_sphere(void)
{
    enum { COUNT = 20000 };
    double sum = 0.0;
    make_even(0.7f);
    for (int i = 0; i < COUNT; i++) {
        vec3 d;
        sum += 1.0 / (double)environment_sample(&environment, numbers(i), &d);
    }
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(
        0.4f, 4.0f * PI, (float)(sum / COUNT),
        "the mean of 1 / density is the solid angle of the sphere, 4 pi");
}

static void upper_and_lower_half_are_as_likely(void)
{
    enum { COUNT = 8000 };
    int up = 0, front = 0;
    make_even(2.0f);
    for (int i = 0; i < COUNT; i++) {
        vec3 d = {0.0f, 0.0f, 0.0f};
        environment_sample(&environment, numbers(i), &d);
        up += d.z > 0.0f;
        front += d.y > 0.0f;
    }
    TEST_ASSERT_INT_WITHIN_MESSAGE(300, COUNT / 2, up, "directions with z > 0");
    TEST_ASSERT_INT_WITHIN_MESSAGE(300, COUNT / 2, front,
                                   "directions with y > 0");
}

static void a_black_map_is_no_trouble(void)
{
    vec3 d = {0.0f, 0.0f, 1.0f};
    image = image_make(8, 4);
    environment = environment_make(&image, 1.0f, transform_identity());
    float density = environment_sample(&environment, numbers(1), &d);
    TEST_ASSERT_TRUE_MESSAGE(density >= 0.0f && isfinite(density),
                             "the density of a pick in a black map");
    density = environment_pdf(&environment, d);
    TEST_ASSERT_TRUE_MESSAGE(density >= 0.0f && isfinite(density),
                             "the density of a direction in a black map");
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(a_texel_is_seen_at_its_centre);
    RUN_TEST(scale_multiplies);
    RUN_TEST(between_centres_neighbours_blend);
    RUN_TEST(the_last_column_meets_the_first);
    RUN_TEST(the_map_turns_with_its_light);
    RUN_TEST(a_pick_has_one_density);
    RUN_TEST(an_even_sky_covers_the_sphere);
    RUN_TEST(upper_and_lower_half_are_as_likely);
    RUN_TEST(a_black_map_is_no_trouble);
    return UNITY_END();
}
