/* test_environment.c - light from everywhere. */
#include "lights/environment_map.h"

#include <stdio.h>

#include "base/constants.h"
#include "base/memory.h"
#include "lights/light.h"
#include "sampling/test_density.h"
#include "sampling/warp.h"
#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

/* ---- maps ---- */

/* Texels of all kinds: different everywhere, a fifth black, one a sun. */
static struct image varied_map(int width, int height, float sun)
{
    struct image image = image_make(width, height);
    for (int i = 0; i < width * height; i++) {
        uint64_t key = random_key(5, (uint64_t)i, 0);
        float value = random_float(key, 0);
        value = value < 0.2f ? 0.0f : value;
        image.pixels[i] = rgb_make(value, 0.5f * value, 0.1f);
        if (value == 0.0f)
            image.pixels[i] = rgb_grey(0.0f);
    }
    if (sun > 0.0f)
        image.pixels[height / 3 * width + width / 5] = rgb_grey(sun);
    return image;
}

static struct image single_texel(int width, int height, int x, int y)
{
    struct image image = image_make(width, height);
    image.pixels[y * width + x] = rgb_make(1.0f, 2.0f, 4.0f);
    return image;
}

/* About no axis in particular. */
static struct transform turned(void)
{
    vec3 z = vec3_normalize(vec3_make(0.4f, -0.7f, 0.5f)), x, y;
    struct transform t;
    vec3_frame(z, &x, &y);
    const float rows[16] = {x.x, y.x, z.x, 0.0f, x.y,  y.y,  z.y,  0.0f,
                            x.z, y.z, z.z, 0.0f, 0.0f, 0.0f, 0.0f, 1.0f};
    TEST_ASSERT_TRUE(transform_from_rows(rows, &t));
    return t;
}

static vec3 direction_at(float u, float v)
{
    float phi = 2.0f * PI * u, theta = PI * v;
    return vec3_make(sinf(theta) * cosf(phi), sinf(theta) * sinf(phi),
                     cosf(theta));
}

static vec2 numbers(uint64_t seed, int i)
{
    uint64_t key = random_key(seed, 0, (uint64_t)i);
    return vec2_make(random_float(key, 0), random_float(key, 1));
}

/* ---- radiance ---- */

/* An asymmetric map: mirrored, turned or upside down, it would not fit. */
static void a_texel_is_where_the_convention_says(void)
{
    struct image image = single_texel(8, 4, 1, 0);
    struct environment e = environment_make(&image, 3.0f, transform_identity());
    vec3 center = direction_at(1.5f / 8.0f, 0.5f / 4.0f);
    TEST_ASSERT_TRUE(center.x > 0.0f && center.y > 0.0f && center.z > 0.0f);
    rgb color = environment_radiance(&e, center);
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, 3.0f, color.r);
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, 6.0f, color.g);
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, 12.0f, color.b);
    vec3 mirrored = vec3_make(center.x, -center.y, center.z);
    TEST_ASSERT_TRUE(rgb_is_black(environment_radiance(&e, mirrored)));
    vec3 below = vec3_make(center.x, center.y, -center.z);
    TEST_ASSERT_TRUE(rgb_is_black(environment_radiance(&e, below)));
    environment_free(&e);
    image_free(&image);
}

static void the_transform_takes_local_to_world(void)
{
    struct image image = varied_map(12, 6, 0.0f);
    struct transform t = turned();
    struct environment local =
        environment_make(&image, 1.0f, transform_identity());
    struct environment world = environment_make(&image, 1.0f, t);
    for (int i = 0; i < 1000; i++) {
        vec3 d = warp_sphere(numbers(1, i));
        rgb want = environment_radiance(&local, d);
        rgb got = environment_radiance(&world, transform_direction(&t, d));
        TEST_ASSERT_FLOAT_WITHIN(1e-4f, want.r, got.r);
    }
    environment_free(&local);
    environment_free(&world);
    image_free(&image);
}

/* Half way between the last and the first column both count half; a quarter
 * of a texel from a centre, a quarter. */
static void it_wraps_around(void)
{
    struct image image = single_texel(8, 4, 7, 2);
    struct environment e = environment_make(&image, 1.0f, transform_identity());
    float v = 2.5f / 4.0f;
    static const float across[] = {-0.5f, -0.25f, 0.0f, 0.25f, 0.4999f};
    for (int i = 0; i < 5; i++) {
        rgb color = environment_radiance(&e, direction_at(across[i] / 8.0f, v));
        TEST_ASSERT_FLOAT_WITHIN(1e-4f, 0.5f - across[i], color.r);
    }
    environment_free(&e);
    image_free(&image);
}

/* Above the first row's centres only the azimuth counts. */
static void it_clamps_at_the_poles(void)
{
    struct image image = single_texel(8, 4, 2, 0);
    struct environment e = environment_make(&image, 1.0f, transform_identity());
    rgb low = environment_radiance(&e, direction_at(2.7f / 8.0f, 0.125f));
    rgb high = environment_radiance(&e, direction_at(2.7f / 8.0f, 0.001f));
    TEST_ASSERT_FLOAT_WITHIN(1e-3f, 0.8f, low.r);
    TEST_ASSERT_FLOAT_WITHIN(1e-3f, 0.8f, high.r);
    environment_free(&e);
    image_free(&image);
}

static void the_poles_themselves_are_defined(void)
{
    struct image image = varied_map(12, 6, 1e4f);
    struct environment e = environment_make(&image, 1.0f, transform_identity());
    for (int i = -1; i <= 1; i += 2) {
        vec3 pole = vec3_make(0.0f, -0.0f, (float)i);
        rgb color = environment_radiance(&e, pole);
        TEST_ASSERT_TRUE(isfinite(color.r) && color.r >= 0.0f);
        float pdf = environment_pdf(&e, pole);
        TEST_ASSERT_TRUE(isfinite(pdf) && (pdf > 0.0f || rgb_is_black(color)));
    }
    environment_free(&e);
    image_free(&image);
}

/* ---- density ---- */

static bool pick(const void *context, vec2 random, vec3 *direction)
{
    const struct environment *e = context;
    float pdf = environment_sample(e, random, direction);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 1.0f, vec3_length(*direction));
    TEST_ASSERT_EQUAL_FLOAT(environment_pdf(e, *direction), pdf);
    return pdf > 0.0f;
}

static double density(const void *context, vec3 direction)
{
    return environment_pdf(context, direction);
}

static struct density_test all_around(const struct environment *e)
{
    struct density_test test = {.context = e,
                                .sample = pick,
                                .pdf = density,
                                .axis = vec3_make(0.0f, 0.6f, 0.8f),
                                .one_minus_cosine = 2.0,
                                .rows = 24,
                                .columns = 48,
                                .subdivisions = 12,
                                .samples = 200000};
    return test;
}

static void samples_follow_the_density(void)
{
    static const int sizes[][2] = {{1, 1}, {1, 2}, {2, 1}, {3, 5}, {12, 6}};
    for (int i = 0; i < 10; i++) {
        float sun = i < 5 ? 0.5f : 1e3f;
        struct image image = varied_map(sizes[i % 5][0], sizes[i % 5][1], sun);
        struct environment e = environment_make(&image, 2.0f, turned());
        struct density_test test = all_around(&e);
        struct density_result r = density_compare(&test);
        TEST_ASSERT_DOUBLE_WITHIN(2e-3, 1.0, r.integral);
        TEST_ASSERT_TRUE(r.chi_squared < r.limit);
        environment_free(&e);
        image_free(&image);
    }
}

/* A large map and a sun of one texel, looked at closely: samples elsewhere
 * count as failed. */
struct close_up {
    const struct environment *e;
    vec3 axis;
    float one_minus_cosine;
};

static bool pick_close(const void *context, vec2 random, vec3 *direction)
{
    const struct close_up *c = context;
    return pick(c->e, random, direction) &&
           1.0f - vec3_dot(*direction, c->axis) < c->one_minus_cosine;
}

static double density_close(const void *context, vec3 direction)
{
    return density(((const struct close_up *)context)->e, direction);
}

static void expect_close_fit(const struct environment *e, vec3 axis)
{
    struct close_up c = {e, axis, 1.0f - cosf(0.04f)};
    struct density_test test = all_around(e);
    test.context = &c;
    test.sample = pick_close;
    test.pdf = density_close;
    test.axis = axis;
    test.one_minus_cosine = (double)c.one_minus_cosine * 1.0001;
    int samples = test.samples;
    test.samples = 0;
    test.failed_share = 1.0 - density_compare(&test).integral;
    test.samples = samples;
    struct density_result r = density_compare(&test);
    TEST_ASSERT_TRUE(r.integral > 0.05 && r.integral < 1.0);
    TEST_ASSERT_TRUE(r.chi_squared < r.limit);
}

static void samples_follow_the_density_around_a_sun(void)
{
    struct image image = varied_map(256, 128, 1e5f);
    struct transform t = turned();
    struct environment e = environment_make(&image, 1.0f, t);
    vec3 sun = direction_at(51.5f / 256.0f, 42.5f / 128.0f);
    expect_close_fit(&e, transform_direction(&t, sun));
    environment_free(&e);
    image_free(&image);
}

/* At a pole the cells of a map are slivers. */
static void samples_follow_the_density_at_the_poles(void)
{
    for (int i = 0; i < 2; i++) {
        struct image image = image_make(64, 128);
        for (int x = 0; x < 64 * 6; x++)
            image.pixels[(i == 0 ? 0 : 64 * 122) + x] =
                rgb_grey(1.0f + 10.0f * random_float(9, (uint32_t)x));
        struct environment e =
            environment_make(&image, 1.0f, transform_identity());
        expect_close_fit(&e, vec3_make(0.0f, 0.0f, i == 0 ? 1.0f : -1.0f));
        environment_free(&e);
        image_free(&image);
    }
}

/* Light that is never picked is lost, also the faint rim of a texel. */
static void the_density_is_positive_where_there_is_light(void)
{
    struct image image = single_texel(16, 8, 3, 5);
    struct environment e = environment_make(&image, 1.0f, transform_identity());
    int bright = 0;
    for (int i = 0; i < 100000; i++) {
        vec3 d = warp_sphere(numbers(2, i));
        bool lit = rgb_luminance(environment_radiance(&e, d)) > 1e-4f;
        TEST_ASSERT_TRUE(!lit || environment_pdf(&e, d) > 0.0f);
        bright += lit;
    }
    TEST_ASSERT_TRUE(bright > 500);
    environment_free(&e);
    image_free(&image);
}

/* Sampling pays where radiance / density stays the same. Here it does, but for
 * how sin theta varies within a patch: least far from the poles. Also the dark
 * sky keeps its share beside a sun 1e9 times as bright. */
static void the_density_is_proportional_to_luminance(void)
{
    struct image image = varied_map(256, 128, 1e9f);
    struct environment e = environment_make(&image, 1.0f, transform_identity());
    double total = 4.0 * acos(-1.0) * (double)environment_mean_luminance(&e);
    for (int i = 0; i < 100000; i++) {
        vec3 d = warp_sphere(numbers(3, i));
        if (fabsf(d.z) > 0.9f)
            continue;
        double want = (double)rgb_luminance(environment_radiance(&e, d));
        double got = (double)environment_pdf(&e, d) * total;
        TEST_ASSERT_DOUBLE_WITHIN(0.03 * want, want, got);
    }
    environment_free(&e);
    image_free(&image);
}

/* In 8192 rows the first covers 7e-8 of cos theta: one step of z in float.
 * From a black first row to the second the density still rises evenly. */
static void a_fine_map_has_no_steps_at_the_pole(void)
{
    enum { ROWS = 8192, STEPS = 100 };
    struct image image = single_texel(1, ROWS, 0, 1);
    struct environment e = environment_make(&image, 1.0f, transform_identity());
    float top = environment_pdf(&e, direction_at(0.1f, 1.499f / ROWS));
    float last = 0.0f;
    for (int i = 0; i < STEPS; i++) {
        float v = (0.5f + (float)i / STEPS) / ROWS;
        float now = environment_pdf(&e, direction_at(0.1f, v));
        TEST_ASSERT_TRUE(now >= last && now - last < 0.03f * top);
        last = now;
    }
    TEST_ASSERT_FLOAT_WITHIN(0.03f * top, top, last);
    environment_free(&e);
    image_free(&image);
}

static void a_black_map_fails_to_pick(void)
{
    struct image image = image_make(4, 2);
    struct light light = {.kind = LIGHT_ENVIRONMENT};
    light.environment = environment_make(&image, 1.0f, transform_identity());
    struct light_sample s;
    vec3 direction, up = vec3_make(0.0f, 0.0f, 1.0f);
    vec2 random = vec2_make(0.5f, 0.5f);
    TEST_ASSERT_EQUAL_FLOAT(
        0.0f, environment_sample(&light.environment, random, &direction));
    TEST_ASSERT_EQUAL_FLOAT(0.0f, environment_pdf(&light.environment, up));
    TEST_ASSERT_FALSE(light_sample(&light, up, random, &s));
    TEST_ASSERT_EQUAL_FLOAT(0.0f, light_power(&light, 1.0f));
    light_free(&light);
    image_free(&image);
}

static void black_is_never_picked(void)
{
    struct image image = single_texel(16, 8, 3, 5);
    struct environment e = environment_make(&image, 1.0f, turned());
    for (int i = 0; i < 20000; i++) {
        vec3 d;
        TEST_ASSERT_TRUE(environment_sample(&e, numbers(4, i), &d) > 0.0f);
        TEST_ASSERT_FALSE(rgb_is_black(environment_radiance(&e, d)));
    }
    environment_free(&e);
    image_free(&image);
}

static void the_ends_of_the_range_are_safe(void)
{
    struct image image = varied_map(12, 6, 1e3f);
    struct environment e = environment_make(&image, 1.0f, transform_identity());
    const float ends[] = {0.0f, 0x1p-24f, 0.5f, ONE_MINUS_EPSILON};
    for (int i = 0; i < 16; i++) {
        vec3 d;
        vec2 random = vec2_make(ends[i % 4], ends[i / 4]);
        float pdf = environment_sample(&e, random, &d);
        TEST_ASSERT_TRUE(vec3_is_finite(d) && isfinite(pdf) && pdf >= 0.0f);
    }
    environment_free(&e);
    image_free(&image);
}

/* ---- closed forms ---- */

static void a_constant_map_has_a_constant_density(void)
{
    struct image image = image_make(1, 1);
    image.pixels[0] = rgb_make(0.5f, 0.25f, 2.0f);
    struct environment e = environment_make(&image, 3.0f, turned());
    for (int i = 0; i < 1000; i++) {
        vec3 d;
        TEST_ASSERT_FLOAT_WITHIN(1e-6f, 1.0f / (4.0f * PI),
                                 environment_sample(&e, numbers(5, i), &d));
        TEST_ASSERT_FLOAT_WITHIN(1e-6f, 6.0f, environment_radiance(&e, d).b);
    }
    TEST_ASSERT_FLOAT_WITHIN(1e-5f, 3.0f * rgb_luminance(image.pixels[0]),
                             environment_mean_luminance(&e));
    environment_free(&e);
    image_free(&image);
}

/* Irradiance (red) on a surface with this normal, by an even grid. */
static double irradiance(const struct light *light, vec3 normal)
{
    enum { SIDE = 400 };
    double sum = 0.0;
    for (int i = 0; i < SIDE * SIDE; i++) {
        vec2 random = vec2_make(((float)(i % SIDE) + 0.5f) / SIDE,
                                ((float)(i / SIDE) + 0.5f) / SIDE);
        struct light_sample s;
        if (!light_sample(light, normal, random, &s))
            continue;
        TEST_ASSERT_TRUE(s.infinite && !s.delta);
        double cosine = fmax(0.0, (double)vec3_dot(s.direction, normal));
        sum += (double)s.radiance.r * cosine / (double)s.pdf;
    }
    return sum / ((double)SIDE * SIDE);
}

static void a_constant_map_gives_pi_l(void)
{
    struct image image = image_make(16, 8);
    for (int i = 0; i < 16 * 8; i++)
        image.pixels[i] = rgb_grey(0.7f);
    struct light light = {.kind = LIGHT_ENVIRONMENT};
    light.environment = environment_make(&image, 2.0f, turned());
    vec3 normal = vec3_normalize(vec3_make(0.2f, 0.9f, -0.4f));
    TEST_ASSERT_DOUBLE_WITHIN(2e-3, acos(-1.0) * 1.4,
                              irradiance(&light, normal));
    TEST_ASSERT_FLOAT_WITHIN(0.1f, PI * 9.0f * 4.0f * PI * 1.4f,
                             light_power(&light, 3.0f));
    TEST_ASSERT_FALSE(light_is_delta(&light));
    light_free(&light);
    image_free(&image);
}

/* Against an even sum over all directions, which asks the density nothing. */
static void a_varied_map_gives_the_right_irradiance(void)
{
    enum { SIDE = 600 };
    struct image image = varied_map(24, 12, 100.0f);
    struct light light = {.kind = LIGHT_ENVIRONMENT};
    light.environment = environment_make(&image, 1.0f, turned());
    vec3 normal = vec3_normalize(vec3_make(0.2f, 0.9f, 0.4f));
    double sum = 0.0, mean = 0.0;
    for (int i = 0; i < SIDE * SIDE; i++) {
        vec3 d = warp_sphere(vec2_make(((float)(i % SIDE) + 0.5f) / SIDE,
                                       ((float)(i / SIDE) + 0.5f) / SIDE));
        rgb l = environment_radiance(&light.environment, d);
        sum += (double)l.r * fmax(0.0, (double)vec3_dot(d, normal));
        mean += (double)rgb_luminance(l);
    }
    sum *= 4.0 * acos(-1.0) / ((double)SIDE * SIDE);
    mean /= (double)SIDE * SIDE;
    TEST_ASSERT_DOUBLE_WITHIN(3e-3 * sum, sum, irradiance(&light, normal));
    TEST_ASSERT_DOUBLE_WITHIN(
        1e-2 * mean, mean,
        (double)environment_mean_luminance(&light.environment));
    light_free(&light);
    image_free(&image);
}

/* ---- what it is for ---- */

/* A blue dome, brighter at the horizon, and a sun half a degree wide that
 * gives four fifths of the light, as at noon. */
static struct image sunny_sky(void)
{
    struct image image = image_make(1024, 512);
    vec3 sun = direction_at(0.3f, 0.2f);
    for (int y = 0; y < 256; y++)
        for (int x = 0; x < 1024; x++) {
            float u = ((float)x + 0.5f) / 1024.0f;
            float v = ((float)y + 0.5f) / 512.0f;
            float glow = 0.5f + v;
            bool in_sun = vec3_dot(sun, direction_at(u, v)) > cosf(0.00465f);
            image.pixels[y * 1024 + x] =
                in_sun ? rgb_grey(2e5f)
                       : rgb_make(0.5f * glow, 0.8f * glow, 1.5f * glow);
        }
    return image;
}

/* Estimates of the irradiance on a floor, f / p with one direction each. Their
 * mean square is the integral of f^2 / p: for even sampling, with p = 1 / 4 pi,
 * it can be had from the same directions, and more surely than from even ones,
 * of which few would find the sun. */
static void a_sunny_sky_is_far_less_noisy_than_by_even_sampling(void)
{
    enum { COUNT = 200000 };
    struct image image = sunny_sky();
    struct environment e = environment_make(&image, 1.0f, transform_identity());
    double sum = 0.0, square = 0.0, square_even = 0.0;
    for (int i = 0; i < COUNT; i++) {
        vec3 d;
        double p = (double)environment_sample(&e, numbers(7, i), &d);
        double f = (double)rgb_luminance(environment_radiance(&e, d)) *
                   fmax(0.0, (double)d.z);
        sum += f / p / COUNT;
        square += f / p * (f / p) / COUNT;
        square_even += f * f * 4.0 * acos(-1.0) / p / COUNT;
    }
    double ratio = (square_even - sum * sum) / (square - sum * sum);
    printf("variance of even over importance sampling: %.0f\n", ratio);
    TEST_ASSERT_TRUE(ratio > 200.0);
    environment_free(&e);
    image_free(&image);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(a_texel_is_where_the_convention_says);
    RUN_TEST(the_transform_takes_local_to_world);
    RUN_TEST(it_wraps_around);
    RUN_TEST(it_clamps_at_the_poles);
    RUN_TEST(the_poles_themselves_are_defined);
    RUN_TEST(samples_follow_the_density);
    RUN_TEST(samples_follow_the_density_around_a_sun);
    RUN_TEST(samples_follow_the_density_at_the_poles);
    RUN_TEST(the_density_is_positive_where_there_is_light);
    RUN_TEST(the_density_is_proportional_to_luminance);
    RUN_TEST(a_fine_map_has_no_steps_at_the_pole);
    RUN_TEST(a_black_map_fails_to_pick);
    RUN_TEST(black_is_never_picked);
    RUN_TEST(the_ends_of_the_range_are_safe);
    RUN_TEST(a_constant_map_has_a_constant_density);
    RUN_TEST(a_constant_map_gives_pi_l);
    RUN_TEST(a_varied_map_gives_the_right_irradiance);
    RUN_TEST(a_sunny_sky_is_far_less_noisy_than_by_even_sampling);
    return UNITY_END();
}
