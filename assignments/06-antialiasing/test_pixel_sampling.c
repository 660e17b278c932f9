/* test_pixel_sampling.c - the public tests of assignment 06.
 *
 * Places are on the film, in pixels: pixel (7, 3) is the square from (7, 3) to
 * (8, 4), and its centre is (7.5, 3.5). Read a test's name and its message; the
 * contract is in camera/pixel_sampling.h. */
#include "camera/pixel_sampling.h"

#include "unity.h"

static const struct sample_number ONLY = {0, 1, 0};

void setUp(void)
{
}

void tearDown(void)
{
}

static struct filter filter_of(enum filter_kind kind, float radius)
{
    struct film_settings film = {.width = 64,
                                 .height = 64,
                                 .filter = kind,
                                 .filter_radius = radius,
                                 .alpha = 2.0f,
                                 .b = 1.0f / 3.0f,
                                 .c = 1.0f / 3.0f};
    return filter_make(&film);
}

/* The middle of cell (i, j) of a grid over the unit square. */
static vec2 grid(int i, int j, int side)
{
    return vec2_make(((float)i + 0.5f) / (float)side,
                     ((float)j + 0.5f) / (float)side);
}

static void expect_within(const struct filter *f, int x, int y, vec2 random,
                          const char *why)
{
    struct pixel_sample s = pixel_sample(f, x, y, ONLY, random);
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(f->radius + 1e-4f, (float)x + 0.5f,
                                     s.place.x, why);
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(f->radius + 1e-4f, (float)y + 0.5f,
                                     s.place.y, why);
}

static void places_are_in_the_pixel(void)
{
    struct filter f = filter_of(FILTER_BOX, 0.5f);
    for (int i = 0; i < 8; i++)
        for (int j = 0; j < 8; j++)
            expect_within(&f, 7, 3, grid(i, j, 8),
                          "a box of radius 0.5 around the centre of pixel "
                          "(7, 3) is the pixel itself");
}

static void places_of_the_first_pixel_are_in_it(void)
{
    struct filter f = filter_of(FILTER_BOX, 0.5f);
    expect_within(&f, 0, 0, vec2_make(0.0f, 0.0f),
                  "pixel (0, 0), random numbers 0 and 0");
    expect_within(&f, 0, 0, vec2_make(0.999999f, 0.999999f),
                  "pixel (0, 0), random numbers just below 1");
}

static void places_are_within_a_larger_reach(void)
{
    struct filter f = filter_of(FILTER_GAUSSIAN, 2.0f);
    for (int i = 0; i < 8; i++)
        expect_within(&f, 40, 50, grid(i, 7 - i, 8),
                      "at most the radius, 2, from the centre of (40, 50)");
}

static void other_numbers_are_another_place(void)
{
    struct filter f = filter_of(FILTER_BOX, 0.5f);
    vec2 a = pixel_sample(&f, 5, 5, ONLY, vec2_make(0.2f, 0.6f)).place;
    vec2 b = pixel_sample(&f, 5, 5, ONLY, vec2_make(0.7f, 0.6f)).place;
    vec2 c = pixel_sample(&f, 5, 5, ONLY, vec2_make(0.2f, 0.1f)).place;
    TEST_ASSERT_TRUE_MESSAGE(a.x != b.x || a.y != b.y,
                             "another first number: another place");
    TEST_ASSERT_TRUE_MESSAGE(a.x != c.x || a.y != c.y,
                             "another second number: another place");
}

/* Of all samples of a pixel, whatever their number. */
static void the_mean_place_is_the_centre(void)
{
    enum { SIDE = 32 };
    struct filter f = filter_of(FILTER_BOX, 0.5f);
    double x = 0.0, y = 0.0, weight = 0.0;
    struct sample_number number = {0, 4, 0};
    for (; number.index < 4; number.index++)
        for (int i = 0; i < SIDE * SIDE; i++) {
            struct pixel_sample s = pixel_sample(
                &f, 20, 10, number, grid(i % SIDE, i / SIDE, SIDE));
            x += (double)(s.weight * s.place.x);
            y += (double)(s.weight * s.place.y);
            weight += (double)s.weight;
        }
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(0.02f, 20.5f, (float)(x / weight), "x");
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(0.02f, 10.5f, (float)(y / weight), "y");
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(0.02f, 1.0f,
                                     (float)(weight / (4 * SIDE * SIDE)),
                                     "the weights are 1 on average");
}

static void expect_value(const struct pixel_sums *sums, float r, float g,
                         float b, const char *why)
{
    rgb c = pixel_value(sums);
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(1e-5f, r, c.r, why);
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(1e-5f, g, c.g, why);
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(1e-5f, b, c.b, why);
}

static void no_samples_are_black(void)
{
    struct pixel_sums none = {{0.0}, 0.0, 0};
    expect_value(&none, 0.0f, 0.0f, 0.0f, "no samples: black, and no NaN");
}

static void one_sample_is_the_pixel(void)
{
    struct pixel_sums sums = {{0.0}, 0.0, 0};
    pixel_add(&sums, rgb_make(0.25f, 0.5f, 4.0f), 1.0f);
    TEST_ASSERT_EQUAL_UINT32_MESSAGE(1, sums.samples, "one sample was added");
    expect_value(&sums, 0.25f, 0.5f, 4.0f, "one sample is its own mean");
}

static void equal_weights_give_the_mean(void)
{
    struct pixel_sums sums = {{0.0}, 0.0, 0};
    for (int i = 0; i < 10; i++)
        pixel_add(&sums, rgb_make((float)i, 1.0f, 0.0f), 1.0f);
    TEST_ASSERT_EQUAL_UINT32_MESSAGE(10, sums.samples, "ten were added");
    expect_value(&sums, 4.5f, 1.0f, 0.0f, "the mean of 0, 1 ... 9 is 4.5");
}

static void heavier_samples_count_more(void)
{
    struct pixel_sums sums = {{0.0}, 0.0, 0};
    pixel_add(&sums, rgb_make(1.0f, 0.0f, 2.0f), 1.5f);
    pixel_add(&sums, rgb_make(8.0f, 14.0f, 2.0f), 0.25f);
    expect_value(&sums, 2.0f, 2.0f, 2.0f,
                 "1 with weight 1.5 and 8 with weight 0.25 are 2");
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(places_are_in_the_pixel);
    RUN_TEST(places_of_the_first_pixel_are_in_it);
    RUN_TEST(places_are_within_a_larger_reach);
    RUN_TEST(other_numbers_are_another_place);
    RUN_TEST(the_mean_place_is_the_centre);
    RUN_TEST(no_samples_are_black);
    RUN_TEST(one_sample_is_the_pixel);
    RUN_TEST(equal_weights_give_the_mean);
    RUN_TEST(heavier_samples_count_more);
    return UNITY_END();
}
