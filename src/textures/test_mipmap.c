/* test_mipmap.c - the pyramid, the wraps, the levels and the filters. */
#include "textures/mipmap.h"

#include <stdint.h>
#include <stdlib.h>
#include <unity.h>

void setUp(void)
{
}

void tearDown(void)
{
}

/* ---- helpers ---- */

static uint64_t state = 1;

/* Uniform in [0, 1): Marsaglia's xorshift64*. */
static double uniform(void)
{
    state ^= state >> 12;
    state ^= state << 25;
    state ^= state >> 27;
    return (double)((state * UINT64_C(2685821657736338717)) >> 11) * 0x1p-53;
}

static struct image random_image(int width, int height)
{
    struct image image = image_make(width, height);
    for (int i = 0; i < width * height; i++)
        image.pixels[i] =
            rgb_make((float)uniform(), (float)uniform(), (float)uniform());
    return image;
}

static struct image grey_image(int width, int height, float value)
{
    struct image image = image_make(width, height);
    for (int i = 0; i < width * height; i++)
        image.pixels[i] = rgb_grey(value);
    return image;
}

/* Texel x, y is x + 100 y. */
static struct image numbered_image(int width, int height)
{
    struct image image = image_make(width, height);
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++)
            image.pixels[y * width + x] = rgb_grey((float)(x + 100 * y));
    return image;
}

/* A pyramid over a square image of which level i is all of the value i. */
static struct mipmap level_pyramid(int size)
{
    struct mipmap m = mipmap_make(image_make(size, size), WRAP_REPEAT, true);
    for (int i = 0; i < m.level_count; i++)
        for (int k = 0; k < m.levels[i].width * m.levels[i].height; k++)
            m.levels[i].pixels[k] = rgb_grey((float)i);
    return m;
}

static void mean_of(const struct image *image, double mean[3])
{
    int count = image->width * image->height;
    mean[0] = mean[1] = mean[2] = 0.0;
    for (int i = 0; i < count; i++) {
        mean[0] += (double)image->pixels[i].r / count;
        mean[1] += (double)image->pixels[i].g / count;
        mean[2] += (double)image->pixels[i].b / count;
    }
}

static vec2 turned(double length, double angle)
{
    return vec2_make((float)(length * cos(angle)),
                     (float)(length * sin(angle)));
}

/* ---- the pyramid ---- */

static void check_pyramid(int width, int height, int level_count)
{
    double mean[3], level_mean[3];
    struct mipmap m =
        mipmap_make(random_image(width, height), WRAP_REPEAT, true);
    TEST_ASSERT_EQUAL_INT(level_count, m.level_count);
    mean_of(&m.levels[0], mean);
    for (int i = 1; i < m.level_count; i++) {
        int w = m.levels[i - 1].width / 2, h = m.levels[i - 1].height / 2;
        TEST_ASSERT_EQUAL_INT(w > 1 ? w : 1, m.levels[i].width);
        TEST_ASSERT_EQUAL_INT(h > 1 ? h : 1, m.levels[i].height);
        mean_of(&m.levels[i], level_mean);
        for (int c = 0; c < 3; c++)
            TEST_ASSERT_DOUBLE_WITHIN(2e-7, mean[c], level_mean[c]);
    }
    TEST_ASSERT_EQUAL_INT(1, m.levels[m.level_count - 1].width);
    TEST_ASSERT_EQUAL_INT(1, m.levels[m.level_count - 1].height);
    mipmap_free(&m);
}

static void test_every_level_has_the_mean_of_the_image(void)
{
    state = 11;
    check_pyramid(1, 1, 1);
    check_pyramid(1, 7, 3);
    check_pyramid(5, 3, 3);
    check_pyramid(64, 64, 7);
    check_pyramid(257, 100, 9);
    check_pyramid(3, 200, 8);
}

/* Not only the mean: 5 texels become 2 of the width 2.5 each. */
static void test_an_odd_row_is_weighted_by_area(void)
{
    struct image row = image_make(5, 1);
    for (int i = 0; i < 5; i++)
        row.pixels[i] = rgb_grey((float)(1 << i));
    struct mipmap m = mipmap_make(row, WRAP_CLAMP, true);
    TEST_ASSERT_EQUAL_FLOAT(1.0f / 2.5f * (1 + 2 + 0.5f * 4),
                            mipmap_texel(&m, 1, 0, 0).r);
    TEST_ASSERT_EQUAL_FLOAT(1.0f / 2.5f * (0.5f * 4 + 8 + 16),
                            mipmap_texel(&m, 1, 1, 0).r);
    mipmap_free(&m);
}

static void test_an_even_image_halves_in_blocks_of_four(void)
{
    struct mipmap m = mipmap_make(numbered_image(4, 4), WRAP_CLAMP, true);
    TEST_ASSERT_EQUAL_FLOAT(50.5f, mipmap_texel(&m, 1, 0, 0).r);
    TEST_ASSERT_EQUAL_FLOAT(52.5f, mipmap_texel(&m, 1, 1, 0).r);
    TEST_ASSERT_EQUAL_FLOAT(250.5f, mipmap_texel(&m, 1, 0, 1).r);
    mipmap_free(&m);
}

static void test_one_level_on_request(void)
{
    struct mipmap m = mipmap_make(random_image(8, 8), WRAP_REPEAT, false);
    TEST_ASSERT_EQUAL_INT(1, m.level_count);
    vec2 wide = vec2_make(0.7f, 0.0f);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, mipmap_level(&m, wide, wide));
    mipmap_free(&m);
}

/* ---- wraps ---- */

static float column_at(enum texture_wrap wrap, int x)
{
    struct mipmap m = mipmap_make(numbered_image(3, 2), wrap, false);
    float value = mipmap_texel(&m, 0, x, 0).r;
    mipmap_free(&m);
    return value;
}

static float row_at(enum texture_wrap wrap, int y)
{
    struct mipmap m = mipmap_make(numbered_image(3, 2), wrap, false);
    float value = mipmap_texel(&m, 0, 1, y).r - 1.0f;
    mipmap_free(&m);
    return value / 100.0f;
}

static void test_wraps_near_the_image(void)
{
    static const float repeat[] = {0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1};
    static const float clamp[] = {0, 0, 0, 0, 1, 2, 2, 2, 2, 2, 2};
    static const float mirror[] = {2, 1, 0, 0, 1, 2, 2, 1, 0, 0, 1};
    for (int i = 0; i < 11; i++) {
        TEST_ASSERT_EQUAL_FLOAT(repeat[i], column_at(WRAP_REPEAT, i - 3));
        TEST_ASSERT_EQUAL_FLOAT(clamp[i], column_at(WRAP_CLAMP, i - 3));
        TEST_ASSERT_EQUAL_FLOAT(mirror[i], column_at(WRAP_MIRROR, i - 3));
        TEST_ASSERT_EQUAL_FLOAT(i >= 3 && i < 6 ? clamp[i] : 0.0f,
                                column_at(WRAP_BLACK, i - 3));
    }
}

static void test_wraps_of_rows(void)
{
    static const float mirror[] = {0, 1, 1, 0, 0, 1, 1, 0, 0};
    for (int y = -4; y < 5; y++) {
        TEST_ASSERT_EQUAL_FLOAT((float)(y & 1), row_at(WRAP_REPEAT, y));
        TEST_ASSERT_EQUAL_FLOAT(y > 0 ? 1.0f : 0.0f, row_at(WRAP_CLAMP, y));
        TEST_ASSERT_EQUAL_FLOAT(mirror[y + 4], row_at(WRAP_MIRROR, y));
    }
}

static void test_wraps_of_the_largest_indices(void)
{
    /* INT_MAX = 2147483647 = 1 (mod 6), INT_MIN = -2147483648 = 4 (mod 6) */
    TEST_ASSERT_EQUAL_FLOAT(1.0f, column_at(WRAP_REPEAT, INT32_MAX));
    TEST_ASSERT_EQUAL_FLOAT(1.0f, column_at(WRAP_REPEAT, INT32_MIN));
    TEST_ASSERT_EQUAL_FLOAT(1.0f, column_at(WRAP_MIRROR, INT32_MAX));
    TEST_ASSERT_EQUAL_FLOAT(1.0f, column_at(WRAP_MIRROR, INT32_MIN));
    TEST_ASSERT_EQUAL_FLOAT(2.0f, column_at(WRAP_CLAMP, INT32_MAX));
    TEST_ASSERT_EQUAL_FLOAT(0.0f, column_at(WRAP_CLAMP, INT32_MIN));
    TEST_ASSERT_EQUAL_FLOAT(0.0f, column_at(WRAP_BLACK, INT32_MAX));
}

/* ---- nearest and bilinear ---- */

static void test_nearest_takes_the_texel_that_uv_is_in(void)
{
    struct mipmap m = mipmap_make(numbered_image(4, 2), WRAP_REPEAT, false);
    TEST_ASSERT_EQUAL_FLOAT(0, mipmap_nearest(&m, 0, vec2_make(0, 0)).r);
    TEST_ASSERT_EQUAL_FLOAT(1, mipmap_nearest(&m, 0, vec2_make(.25f, 0)).r);
    TEST_ASSERT_EQUAL_FLOAT(103,
                            mipmap_nearest(&m, 0, vec2_make(.99f, .99f)).r);
    TEST_ASSERT_EQUAL_FLOAT(0, mipmap_nearest(&m, 0, vec2_make(1, 1)).r);
    TEST_ASSERT_EQUAL_FLOAT(103,
                            mipmap_nearest(&m, 0, vec2_make(-.01f, -.01f)).r);
    mipmap_free(&m);
}

static void test_bilinear_reproduces_a_ramp(void)
{
    struct mipmap m = mipmap_make(numbered_image(7, 5), WRAP_CLAMP, false);
    state = 12;
    for (int i = 0; i < 1000; i++) {
        double x = 0.5 + 6.0 * uniform(), y = 0.5 + 4.0 * uniform();
        vec2 uv = vec2_make((float)(x / 7), (float)(y / 5));
        TEST_ASSERT_DOUBLE_WITHIN(1e-3, x - 0.5 + 100 * (y - 0.5),
                                  mipmap_bilinear(&m, 0, uv).r);
    }
    mipmap_free(&m);
}

static void test_bilinear_has_texel_centres_at_half_integers(void)
{
    struct mipmap m = mipmap_make(numbered_image(4, 4), WRAP_REPEAT, false);
    for (int y = 0; y < 4; y++)
        for (int x = 0; x < 4; x++) {
            vec2 uv = vec2_make(((float)x + .5f) / 4, ((float)y + .5f) / 4);
            TEST_ASSERT_EQUAL_FLOAT((float)(x + 100 * y),
                                    mipmap_bilinear(&m, 0, uv).r);
        }
    /* at the seam: half of texel 3, half of texel 0 */
    TEST_ASSERT_EQUAL_FLOAT(1.5f,
                            mipmap_bilinear(&m, 0, vec2_make(1.0f, 0.125f)).r);
    mipmap_free(&m);
}

/* ---- levels ---- */

static void test_level_is_that_of_the_longest_side(void)
{
    struct mipmap m = level_pyramid(256);
    for (double level = 0.0; level < 8.0; level += 0.05)
        for (double angle = 0.0; angle < 6.28; angle += 0.7) {
            vec2 longer = turned(exp2(level) / 256, angle);
            vec2 shorter = turned(0.5 * exp2(level) / 256, angle * 1.7);
            vec2 uv = vec2_make(0.3f, 0.8f);
            TEST_ASSERT_DOUBLE_WITHIN(1e-4, level,
                                      mipmap_level(&m, longer, shorter));
            TEST_ASSERT_DOUBLE_WITHIN(1e-4, level,
                                      mipmap_level(&m, shorter, longer));
            TEST_ASSERT_DOUBLE_WITHIN(
                0.1, level, mipmap_trilinear(&m, uv, longer, shorter).r);
        }
    mipmap_free(&m);
}

/* Texels of an image 512 x 64 are not square in uv. */
static void test_level_counts_in_texels(void)
{
    struct mipmap m = mipmap_make(image_make(512, 64), WRAP_REPEAT, true);
    vec2 none = vec2_make(0.0f, 0.0f);
    vec2 along_u = vec2_make(1.0f / 16, 0), along_v = vec2_make(0, 1.0f / 16);
    TEST_ASSERT_EQUAL_FLOAT(5.0f, mipmap_level(&m, along_u, none));
    TEST_ASSERT_EQUAL_FLOAT(2.0f, mipmap_level(&m, none, along_v));
    mipmap_free(&m);
}

static void test_level_stays_in_the_pyramid(void)
{
    struct mipmap m = level_pyramid(64);
    vec2 none = vec2_make(0, 0), tiny = vec2_make(1e-9f, 0);
    vec2 huge = vec2_make(3e38f, -3e38f);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, mipmap_level(&m, none, none));
    TEST_ASSERT_EQUAL_FLOAT(0.0f, mipmap_level(&m, tiny, none));
    TEST_ASSERT_EQUAL_FLOAT(6.0f, mipmap_level(&m, none, huge));
    mipmap_free(&m);
}

static void test_trilinear_is_continuous_in_the_level(void)
{
    state = 13;
    struct mipmap m = mipmap_make(random_image(64, 64), WRAP_REPEAT, true);
    vec2 none = vec2_make(0, 0), uv = vec2_make(0.37f, 0.61f);
    float before = mipmap_trilinear(&m, uv, none, none).r;
    for (double level = 0.0; level < 7.0; level += 1e-3) {
        vec2 dx = vec2_make((float)(exp2(level) / 64), 0);
        float value = mipmap_trilinear(&m, uv, dx, none).r;
        TEST_ASSERT_DOUBLE_WITHIN(2e-3, before, value);
        before = value;
    }
    mipmap_free(&m);
}

static void test_trilinear_at_whole_levels_is_bilinear(void)
{
    state = 14;
    struct mipmap m = mipmap_make(random_image(64, 64), WRAP_REPEAT, true);
    vec2 none = vec2_make(0, 0), uv = vec2_make(0.37f, 0.61f);
    for (int level = 0; level < m.level_count; level++) {
        vec2 dx = vec2_make((float)(1 << level) / 64, 0);
        TEST_ASSERT_FLOAT_WITHIN(1e-6f, mipmap_bilinear(&m, level, uv).r,
                                 mipmap_trilinear(&m, uv, dx, none).r);
    }
    mipmap_free(&m);
}

/* ---- all filters ---- */

static void test_a_constant_image_stays_constant(void)
{
    static const int sizes[][2] = {{1, 1}, {1, 7}, {5, 3}, {64, 64}};
    state = 15;
    for (int k = 0; k < 4; k++) {
        struct mipmap m = mipmap_make(
            grey_image(sizes[k][0], sizes[k][1], 0.7f), WRAP_MIRROR, true);
        for (int i = 0; i < 2000; i++) {
            double size = exp2(-8.0 + 10.0 * uniform());
            vec2 uv = vec2_make((float)(8 * uniform() - 4), (float)uniform());
            vec2 dx = turned(size, 6.3 * uniform());
            vec2 dy = turned(size * uniform(), 6.3 * uniform());
            TEST_ASSERT_EQUAL_FLOAT(0.7f, mipmap_bilinear(&m, 0, uv).g);
            TEST_ASSERT_EQUAL_FLOAT(0.7f, mipmap_trilinear(&m, uv, dx, dy).g);
            TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.7f,
                                     mipmap_ewa(&m, uv, dx, dy, 8).g);
        }
        mipmap_free(&m);
    }
}

static void check_hostile(const struct mipmap *m, vec2 uv, vec2 dx, vec2 dy,
                          float anisotropy)
{
    const rgb colors[4] = {mipmap_nearest(m, 0, uv), mipmap_bilinear(m, 0, uv),
                           mipmap_trilinear(m, uv, dx, dy),
                           mipmap_ewa(m, uv, dx, dy, anisotropy)};
    for (int i = 0; i < 4; i++)
        TEST_ASSERT_TRUE(colors[i].r >= 0.0f && colors[i].r <= 1.0f);
}

/* Under the sanitizers this also finds conversions out of range. */
static void test_hostile_coordinates_and_footprints(void)
{
    static const float values[] = {0.0f,  -1e-30f, 0.5f,      -7.25f,
                                   1e9f,  -3e38f,  INFINITY,  -INFINITY,
                                   1e-4f, NAN,     16777216.f};
    enum { COUNT = sizeof values / sizeof values[0] };
    static const int sizes[][2] = {{1, 1}, {300, 1}, {17, 33}};
    state = 16;
    for (int k = 0; k < 12; k++) {
        struct mipmap m =
            mipmap_make(random_image(sizes[k % 3][0], sizes[k % 3][1]),
                        (enum texture_wrap)(k / 3), true);
        for (int i = 0; i < 3000; i++) {
            float v[7];
            for (int n = 0; n < 7; n++)
                v[n] = values[(int)(uniform() * COUNT)];
            check_hostile(&m, vec2_make(v[0], v[1]), vec2_make(v[2], v[3]),
                          vec2_make(v[4], v[5]), v[6]);
        }
        mipmap_free(&m);
    }
}

static void test_what_is_not_finite_counts_as_zero(void)
{
    state = 17;
    for (int wrap = WRAP_REPEAT; wrap <= WRAP_BLACK; wrap++) {
        struct mipmap m =
            mipmap_make(random_image(17, 13), (enum texture_wrap)wrap, true);
        vec2 zero = vec2_make(0, 0), bad = vec2_make(NAN, INFINITY);
        TEST_ASSERT_EQUAL_FLOAT(mipmap_nearest(&m, 0, zero).r,
                                mipmap_nearest(&m, 0, bad).r);
        TEST_ASSERT_EQUAL_FLOAT(mipmap_bilinear(&m, 0, zero).r,
                                mipmap_bilinear(&m, 0, bad).r);
        TEST_ASSERT_EQUAL_FLOAT(0.0f, mipmap_level(&m, bad, zero));
        TEST_ASSERT_EQUAL_FLOAT(mipmap_bilinear(&m, 0, zero).r,
                                mipmap_ewa(&m, zero, bad, zero, 8).r);
        mipmap_free(&m);
    }
}

/* ---- EWA ---- */

/* An ellipse on level 0 by its half axes in texels and two angles: the
 * direction of the longer axis, and which points of the circle dx and dy are
 * the images of. */
static void footprint(const struct mipmap *m, double longer, double shorter,
                      double angle, double start, vec2 *dx, vec2 *dy)
{
    double w = m->levels[0].width, h = m->levels[0].height;
    double ca = cos(angle), sa = sin(angle), cs = cos(start), ss = sin(start);
    *dx = vec2_make((float)((ca * longer * cs - sa * shorter * ss) / w),
                    (float)((sa * longer * cs + ca * shorter * ss) / h));
    *dy = vec2_make((float)((-ca * longer * ss - sa * shorter * cs) / w),
                    (float)((-sa * longer * ss + ca * shorter * cs) / h));
}

/* The definition, by brute force: the mean over the points uv + s dx + t dy of
 * the bilinear image of one level, weighted by exp(-2 q) - exp(-4) where
 * q = s s + t t is below 2. 317 x 317 points of a grid. */
static double integral(const struct mipmap *m, int level, vec2 uv, vec2 dx,
                       vec2 dy)
{
    enum { SIDE = 317 };
    double sum = 0.0, weight = 0.0;
    for (int j = 0; j < SIDE; j++)
        for (int i = 0; i < SIDE; i++) {
            double s = sqrt(2.0) * (2.0 * (i + 0.5) / SIDE - 1.0);
            double t = sqrt(2.0) * (2.0 * (j + 0.5) / SIDE - 1.0);
            double w = exp(-2.0 * (s * s + t * t)) - exp(-4.0);
            vec2 at = vec2_make((float)(uv.x + s * dx.x + t * dy.x),
                                (float)(uv.y + s * dx.y + t * dy.y));
            if (w <= 0.0)
                continue;
            sum += w * mipmap_bilinear(m, level, at).g;
            weight += w;
        }
    return sum / weight;
}

/* Random texels are the hardest image there is. */
static void check_against_integral(double most_anisotropy)
{
    struct mipmap m = mipmap_make(random_image(64, 64), WRAP_REPEAT, true);
    for (int i = 0; i < 50; i++) {
        vec2 dx, dy, uv = vec2_make((float)uniform(), (float)uniform());
        double shorter = 0.75 + 0.75 * uniform();
        double ratio = 1.0 + (most_anisotropy - 1.0) * uniform();
        footprint(&m, ratio * shorter, shorter, 6.3 * uniform(),
                  6.3 * uniform(), &dx, &dy);
        TEST_ASSERT_DOUBLE_WITHIN(0.01, integral(&m, 0, uv, dx, dy),
                                  mipmap_ewa(&m, uv, dx, dy, 16).g);
    }
    mipmap_free(&m);
}

static void test_ewa_of_circles_is_the_gaussian_integral(void)
{
    state = 18;
    check_against_integral(1.0);
}

static void test_ewa_of_ellipses_is_the_gaussian_integral(void)
{
    state = 19;
    check_against_integral(8.0);
}

/* Larger ellipses use smaller levels. A blend of the integrals over the two
 * levels' own images is what is meant. */
static void check_two_levels(int width, int height, double largest)
{
    struct mipmap m =
        mipmap_make(random_image(width, height), WRAP_REPEAT, true);
    for (int i = 0; i < 50; i++) {
        vec2 dx, dy, uv = vec2_make((float)uniform(), (float)uniform());
        double shorter = 2.0 * pow(largest / 4.0, uniform());
        double level = log2(shorter / 1.5);
        int fine = (int)level;
        footprint(&m, (1 + uniform()) * shorter, shorter, 6.3 * uniform(),
                  6.3 * uniform(), &dx, &dy);
        double want = (fine + 1 - level) * integral(&m, fine, uv, dx, dy) +
                      (level - fine) * integral(&m, fine + 1, uv, dx, dy);
        TEST_ASSERT_DOUBLE_WITHIN(0.01, want, mipmap_ewa(&m, uv, dx, dy, 16).g);
    }
    mipmap_free(&m);
}

static void test_ewa_of_large_ellipses_is_the_integral_over_two_levels(void)
{
    state = 20;
    check_two_levels(90, 37, 16.0);
    check_two_levels(64, 2, 8.0); /* levels of 32 x 1, 16 x 1 ... */
}

/* And how far the levels themselves are from the integral over the image: a
 * third of what trilinear makes of the same long ellipses, or less. */
static void test_ewa_is_much_nearer_to_the_integral_than_trilinear(void)
{
    double ewa = 0.0, trilinear = 0.0;
    state = 21;
    struct mipmap m = mipmap_make(random_image(64, 64), WRAP_REPEAT, true);
    for (int i = 0; i < 50; i++) {
        vec2 dx, dy, uv = vec2_make((float)uniform(), (float)uniform());
        double shorter = exp2(-0.5 + 2.5 * uniform());
        footprint(&m, 6 * shorter, shorter, 6.3 * uniform(), 6.3 * uniform(),
                  &dx, &dy);
        double want = integral(&m, 0, uv, dx, dy);
        ewa += pow(mipmap_ewa(&m, uv, dx, dy, 16).g - want, 2.0);
        trilinear += pow(mipmap_trilinear(&m, uv, dx, dy).g - want, 2.0);
    }
    TEST_ASSERT_TRUE(3.0 * sqrt(ewa) < sqrt(trilinear));
    mipmap_free(&m);
}

static void test_ewa_level_is_that_of_the_shorter_axis(void)
{
    struct mipmap m = level_pyramid(256);
    state = 22;
    for (double level = 0.0; level < 4.0; level += 0.04) {
        vec2 dx, dy, uv = vec2_make((float)uniform(), (float)uniform());
        double shorter = 1.5 * exp2(level);
        footprint(&m, 5 * shorter, shorter, 6.3 * uniform(), 6.3 * uniform(),
                  &dx, &dy);
        TEST_ASSERT_DOUBLE_WITHIN(0.1, level, mipmap_ewa(&m, uv, dx, dy, 16).r);
    }
    mipmap_free(&m);
}

static void test_ewa_honours_the_largest_anisotropy(void)
{
    struct mipmap m = level_pyramid(256);
    vec2 dx, dy, uv = vec2_make(0.2f, 0.7f);
    for (int most = 1; most <= 32; most *= 2) {
        footprint(&m, 48, 0.01, 0.3, 1.1, &dx, &dy);
        TEST_ASSERT_DOUBLE_WITHIN(0.1, log2(48.0 / most / 1.5),
                                  mipmap_ewa(&m, uv, dx, dy, (float)most).r);
    }
    /* narrow enough already: no change */
    footprint(&m, 12, 3, 0.3, 1.1, &dx, &dy);
    TEST_ASSERT_EQUAL_FLOAT(mipmap_ewa(&m, uv, dx, dy, 4.01f).r,
                            mipmap_ewa(&m, uv, dx, dy, 32).r);
    mipmap_free(&m);
}

/* Widened, a line is the ellipse of its length and 1 / most of that. */
static void test_ewa_widens_to_an_ellipse(void)
{
    state = 23;
    struct mipmap m = mipmap_make(random_image(64, 64), WRAP_REPEAT, true);
    vec2 dx, dy, along, none = vec2_make(0, 0), uv = vec2_make(0.4f, 0.1f);
    footprint(&m, 4, 1, 0.9, 0, &dx, &dy);
    along = dx;
    TEST_ASSERT_FLOAT_WITHIN(1e-5f, mipmap_ewa(&m, uv, dx, dy, 16).g,
                             mipmap_ewa(&m, uv, along, none, 4).g);
    mipmap_free(&m);
}

/* The ellipse is what matters, not which of its points dx and dy are. */
static void test_ewa_depends_on_the_ellipse_only(void)
{
    state = 24;
    struct mipmap m = mipmap_make(random_image(64, 64), WRAP_MIRROR, true);
    vec2 dx, dy, dx2, dy2, uv = vec2_make(0.4f, 0.1f);
    for (double start = 0.1; start < 6.0; start += 0.5) {
        footprint(&m, 9, 2, 0.7, 0, &dx, &dy);
        footprint(&m, 9, 2, 0.7, start, &dx2, &dy2);
        TEST_ASSERT_FLOAT_WITHIN(1e-4f, mipmap_ewa(&m, uv, dx, dy, 16).r,
                                 mipmap_ewa(&m, uv, dx2, dy2, 16).r);
    }
    mipmap_free(&m);
}

static void test_ewa_without_a_footprint_is_bilinear(void)
{
    state = 25;
    struct mipmap m = mipmap_make(random_image(9, 5), WRAP_REPEAT, true);
    vec2 none = vec2_make(0, 0), uv = vec2_make(0.4f, 0.1f);
    TEST_ASSERT_EQUAL_FLOAT(mipmap_bilinear(&m, 0, uv).r,
                            mipmap_ewa(&m, uv, none, none, 8).r);
    mipmap_free(&m);
}

static void test_ewa_of_an_enormous_footprint_is_the_mean(void)
{
    state = 26;
    double mean[3];
    struct mipmap m = mipmap_make(random_image(50, 30), WRAP_REPEAT, true);
    mean_of(&m.levels[0], mean);
    rgb color = mipmap_ewa(&m, vec2_make(.1f, .9f), vec2_make(900, 0),
                           vec2_make(0, 1e20f), 8);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, mean[0], color.r);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, mean[2], color.b);
    mipmap_free(&m);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_every_level_has_the_mean_of_the_image);
    RUN_TEST(test_an_odd_row_is_weighted_by_area);
    RUN_TEST(test_an_even_image_halves_in_blocks_of_four);
    RUN_TEST(test_one_level_on_request);
    RUN_TEST(test_wraps_near_the_image);
    RUN_TEST(test_wraps_of_rows);
    RUN_TEST(test_wraps_of_the_largest_indices);
    RUN_TEST(test_nearest_takes_the_texel_that_uv_is_in);
    RUN_TEST(test_bilinear_reproduces_a_ramp);
    RUN_TEST(test_bilinear_has_texel_centres_at_half_integers);
    RUN_TEST(test_level_is_that_of_the_longest_side);
    RUN_TEST(test_level_counts_in_texels);
    RUN_TEST(test_level_stays_in_the_pyramid);
    RUN_TEST(test_trilinear_is_continuous_in_the_level);
    RUN_TEST(test_trilinear_at_whole_levels_is_bilinear);
    RUN_TEST(test_a_constant_image_stays_constant);
    RUN_TEST(test_hostile_coordinates_and_footprints);
    RUN_TEST(test_what_is_not_finite_counts_as_zero);
    RUN_TEST(test_ewa_of_circles_is_the_gaussian_integral);
    RUN_TEST(test_ewa_of_ellipses_is_the_gaussian_integral);
    RUN_TEST(test_ewa_of_large_ellipses_is_the_integral_over_two_levels);
    RUN_TEST(test_ewa_is_much_nearer_to_the_integral_than_trilinear);
    RUN_TEST(test_ewa_level_is_that_of_the_shorter_axis);
    RUN_TEST(test_ewa_honours_the_largest_anisotropy);
    RUN_TEST(test_ewa_widens_to_an_ellipse);
    RUN_TEST(test_ewa_depends_on_the_ellipse_only);
    RUN_TEST(test_ewa_without_a_footprint_is_bilinear);
    RUN_TEST(test_ewa_of_an_enormous_footprint_is_the_mean);
    return UNITY_END();
}
