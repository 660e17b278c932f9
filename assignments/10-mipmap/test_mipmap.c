/* test_mipmap.c - the public tests of assignment 10.
 *
 * Read a test's name and its message; the contract is in textures/mipmap.h. */
#include "textures/mipmap.h"

#include <string.h>

#include "unity.h"

/* The mipmap of the test that runs. */
static struct mipmap m;

void setUp(void)
{
    memset(&m, 0, sizeof m);
}

/* Also after a test that failed. */
void tearDown(void)
{
    mipmap_free(&m);
}

/* Texel x, y is x + 10 y. */
static struct image numbered(int width, int height)
{
    struct image image = image_make(width, height);
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++)
            image.pixels[y * width + x] = rgb_grey((float)(x + 10 * y));
    return image;
}

/* 1 and 0 in turn, as on a chessboard. */
static struct image chessboard(int size)
{
    struct image image = image_make(size, size);
    for (int i = 0; i < size * size; i++)
        image.pixels[i] = rgb_grey((float)((i / size + i % size) % 2));
    return image;
}

/* All levels of a square image that there can be, level i all of the value i:
 * a lookup tells which level it was made in. Needs no pyramid of yours. */
static void level_numbers(int size)
{
    for (; size > 0; size /= 2) {
        struct image level = image_make(size, size);
        for (int i = 0; i < size * size; i++)
            level.pixels[i] = rgb_grey((float)m.level_count);
        m.levels[m.level_count++] = level;
    }
}

static vec2 step(double x, double y)
{
    return vec2_make((float)x, (float)y);
}

/* ---- the pyramid ---- */

static void expect_size(const struct image *level, int width, int height)
{
    TEST_ASSERT_EQUAL_INT_MESSAGE(width, level->width, "width of the level");
    TEST_ASSERT_EQUAL_INT_MESSAGE(height, level->height, "height of the level");
}

static void every_level_is_half_as_large(void)
{
    m = mipmap_make(numbered(8, 4), WRAP_CLAMP, true);
    TEST_ASSERT_EQUAL_INT_MESSAGE(
        4, m.level_count, "8 x 4, 4 x 2, 2 x 1, 1 x 1: that makes four levels");
    expect_size(&m.levels[1], 4, 2);
    expect_size(&m.levels[2], 2, 1);
    expect_size(&m.levels[3], 1, 1);
}

static void one_texel_is_a_pyramid(void)
{
    m = mipmap_make(numbered(1, 1), WRAP_CLAMP, true);
    TEST_ASSERT_EQUAL_INT_MESSAGE(1, m.level_count,
                                  "an image of 1 x 1 has one level: itself");
}

static void a_texel_is_the_mean_of_four(void)
{
    m = mipmap_make(numbered(4, 4), WRAP_CLAMP, true);
    TEST_ASSERT_EQUAL_INT_MESSAGE(3, m.level_count,
                                  "4 x 4, 2 x 2, 1 x 1: three levels");
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(
        1e-3f, 5.5f, m.levels[1].pixels[0].r,
        "level 1, upper left: the mean of 0, 1, 10 and 11");
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(
        1e-3f, 27.5f, m.levels[1].pixels[3].r,
        "level 1, lower right: the mean of 22, 23, 32 and 33");
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(1e-3f, 16.5f, m.levels[2].pixels[0].r,
                                     "level 2: the mean of all texels");
}

static void no_texel_of_an_odd_row_is_lost(void)
{
    m = mipmap_make(numbered(3, 1), WRAP_CLAMP, true);
    TEST_ASSERT_EQUAL_INT_MESSAGE(2, m.level_count, "3 x 1, 1 x 1: two levels");
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(1e-4f, 1.0f, m.levels[1].pixels[0].r,
                                     "the mean of 0, 1 and 2");
}

/* ---- the level ---- */

static void expect_level(float want, vec2 uv_dx, vec2 uv_dy, const char *why)
{
    level_numbers(64);
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(0.01f, want,
                                     mipmap_level(&m, uv_dx, uv_dy), why);
}

static void a_footprint_of_one_texel_is_level_0(void)
{
    expect_level(0.0f, step(1.0 / 64, 0.0), step(0.0, 1.0 / 64),
                 "1/64 of an image of 64 texels is one texel: level 0");
}

static void twice_the_footprint_is_one_level_up(void)
{
    expect_level(2.0f, step(4.0 / 64, 0.0), step(0.0, 4.0 / 64),
                 "both sides are four texels: level 2");
    expect_level(3.0f, step(8.0 / 64, 0.0), step(0.0, 8.0 / 64),
                 "both sides are eight texels: level 3");
}

static void levels_are_not_whole_numbers(void)
{
    expect_level(1.585f, step(3.0 / 64, 0.0), step(0.0, 3.0 / 64),
                 "both sides are three texels: between level 1 and level 2");
}

static void the_longer_side_counts(void)
{
    expect_level(3.0f, step(8.0 / 64, 0.0), step(0.0, 1.0 / 64),
                 "uv_dx is eight texels, uv_dy one");
    expect_level(3.0f, step(1.0 / 64, 0.0), step(0.0, 8.0 / 64),
                 "uv_dy is eight texels, uv_dx one");
}

static void no_footprint_is_level_0(void)
{
    expect_level(0.0f, step(0.0, 0.0), step(0.0, 0.0),
                 "both steps are zero: level 0");
}

/* ---- lookups ---- */

static void trilinear_mixes_two_levels(void)
{
    level_numbers(64);
    vec2 middle = vec2_make(0.5f, 0.5f);
    rgb at_2 = mipmap_trilinear(&m, middle, step(4.0 / 64, 0), step(0, 0));
    rgb between = mipmap_trilinear(&m, middle, step(3.0 / 64, 0), step(0, 0));
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(
        0.01f, 2.0f, at_2.r,
        "a side of four texels: level 2, whose texels are all 2");
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(
        0.01f, 1.585f, between.r,
        "three texels: 1 from level 1 and 2 from level 2, mixed");
}

static void trilinear_close_up_is_bilinear(void)
{
    m = mipmap_make(numbered(4, 4), WRAP_CLAMP, true);
    vec2 uv = vec2_make(0.5f, 0.375f);
    rgb color = mipmap_trilinear(&m, uv, step(0.01, 0), step(0, 0.01));
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(
        0.1f, 11.5f, color.r,
        "between the texels 11 and 12, in the middle of their row");
}

static void ewa_keeps_one_colour(void)
{
    struct image image = image_make(16, 16);
    for (int i = 0; i < 16 * 16; i++)
        image.pixels[i] = rgb_make(0.2f, 0.5f, 0.8f);
    m = mipmap_make(image, WRAP_REPEAT, true);
    rgb color = mipmap_ewa(&m, vec2_make(0.3f, 0.7f), step(0.4, 0.1),
                           step(0.0, 0.1), 8.0f);
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(1e-3f, 0.2f, color.r,
                                     "every texel's red is 0.2");
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(1e-3f, 0.8f, color.b,
                                     "every texel's blue is 0.8");
}

static void ewa_of_many_squares_is_grey(void)
{
    m = mipmap_make(chessboard(64), WRAP_REPEAT, true);
    rgb color = mipmap_ewa(&m, vec2_make(0.31f, 0.64f), step(0.3, 0.0),
                           step(0.0, 0.1), 8.0f);
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(
        0.03f, 0.5f, color.r,
        "19 by 6 squares, half of them white: as grey as the mean");
}

/* Stripes run from left to right, each four texels high: a footprint that is
 * long along them and narrow across them sees one stripe only. */
static void ewa_is_sharp_across_a_long_footprint(void)
{
    struct image image = image_make(64, 64);
    for (int i = 0; i < 64 * 64; i++)
        image.pixels[i] = rgb_grey((float)(i / 64 / 4 % 2));
    m = mipmap_make(image, WRAP_REPEAT, true);
    vec2 in_a_white_stripe = vec2_make(0.5f, 6.0f / 64);
    rgb ewa = mipmap_ewa(&m, in_a_white_stripe, step(16.0 / 64, 0),
                         step(0, 0.5 / 64), 64.0f);
    TEST_ASSERT_TRUE_MESSAGE(ewa.r > 0.8f,
                             "16 texels along a white stripe and half a texel "
                             "across it: more than 0.8 of it is white");
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(every_level_is_half_as_large);
    RUN_TEST(one_texel_is_a_pyramid);
    RUN_TEST(a_texel_is_the_mean_of_four);
    RUN_TEST(no_texel_of_an_odd_row_is_lost);
    RUN_TEST(a_footprint_of_one_texel_is_level_0);
    RUN_TEST(twice_the_footprint_is_one_level_up);
    RUN_TEST(levels_are_not_whole_numbers);
    RUN_TEST(the_longer_side_counts);
    RUN_TEST(no_footprint_is_level_0);
    RUN_TEST(trilinear_mixes_two_levels);
    RUN_TEST(trilinear_close_up_is_bilinear);
    RUN_TEST(ewa_keeps_one_colour);
    RUN_TEST(ewa_of_many_squares_is_grey);
    RUN_TEST(ewa_is_sharp_across_a_long_footprint);
    return UNITY_END();
}
