/* test_camera.c - tests of camera.h, film.h and filter.h. */
#include "camera/camera.h"

#include "camera/film.h"
#include "camera/filter.h"
#include "sampling/sampler.h"

#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

/* From (0, 0, 5) towards -z, +y up. */
static struct camera looking_down_z(float fov, int width, int height)
{
    struct camera_settings settings = {{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, fov};
    struct film_settings film = {
        .width = width, .height = height, .filter_radius = 0.5f};
    return camera_make(&settings, &film);
}

static void expect_direction(vec3 want, ray r, const char *why)
{
    want = vec3_normalize(want);
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(1e-6f, want.x, r.direction.x, why);
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(1e-6f, want.y, r.direction.y, why);
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(1e-6f, want.z, r.direction.z, why);
}

static void expect_ray(const struct camera *c, float x, float y, vec3 want,
                       const char *why)
{
    expect_direction(want, camera_ray(c, vec2_make(x, y)), why);
}

static void the_centre_looks_forward(void)
{
    struct camera c = looking_down_z(90, 8, 6);
    ray r = camera_ray(&c, vec2_make(4, 3));
    expect_direction(vec3_make(0, 0, -1), r, "the film's centre");
    TEST_ASSERT_EQUAL_FLOAT(5, r.origin.z);
    TEST_ASSERT_EQUAL_FLOAT(0, r.t_min);
    TEST_ASSERT_TRUE(isinf(r.t_max));
}

/* 90 degrees: the upper edge is as high as the film is away. */
static void the_corners_span_the_field_of_view(void)
{
    struct camera c = looking_down_z(90, 10, 10);
    expect_ray(&c, 0, 0, vec3_make(-1, 1, -1), "upper left");
    expect_ray(&c, 10, 0, vec3_make(1, 1, -1), "upper right");
    expect_ray(&c, 0, 10, vec3_make(-1, -1, -1), "lower left");
    expect_ray(&c, 10, 10, vec3_make(1, -1, -1), "lower right");
}

static void y_runs_down(void)
{
    struct camera c = looking_down_z(90, 10, 10);
    TEST_ASSERT_TRUE(camera_ray(&c, vec2_make(5, 1)).direction.y > 0.5f);
    TEST_ASSERT_TRUE(camera_ray(&c, vec2_make(5, 9)).direction.y < -0.5f);
}

static void fov_is_vertical(void)
{
    struct camera wide = looking_down_z(90, 30, 10);
    expect_ray(&wide, 15, 0, vec3_make(0, 1, -1), "upper edge");
    expect_ray(&wide, 30, 5, vec3_make(3, 0, -1), "right edge of a wide film");
    struct camera tall = looking_down_z(90, 10, 40);
    expect_ray(&tall, 5, 0, vec3_make(0, 1, -1), "upper edge");
    expect_ray(&tall, 10, 20, vec3_make(0.25f, 0, -1), "right edge");
}

static void fov_is_in_degrees(void)
{
    for (float fov = 1; fov < 179; fov += 7) {
        struct camera c = looking_down_z(fov, 10, 10);
        double angle = (double)fov * 3.14159265358979 / 360.0;
        vec3 d = camera_ray(&c, vec2_make(5, 0)).direction;
        TEST_ASSERT_FLOAT_WITHIN(1e-5f, (float)sin(angle), d.y);
    }
}

static void rays_have_length_one(void)
{
    struct camera c = looking_down_z(120, 64, 48);
    for (uint64_t i = 0; i < 1000; i++) {
        struct sampler s = sampler_start(SAMPLER_INDEPENDENT, 0, 0, i, 1);
        vec2 at = sampler_2d(&s);
        ray r = camera_ray(&c, vec2_make(64 * at.x, 48 * at.y));
        TEST_ASSERT_FLOAT_WITHIN(1e-6f, 1, vec3_length(r.direction));
        TEST_ASSERT_TRUE(r.inverse_direction.x == 1 / r.direction.x);
    }
}

/* Equal steps on the film are equal steps on any plane parallel to it. */
static void straight_lines_stay_straight(void)
{
    struct camera c = looking_down_z(70, 10, 10);
    for (int x = 0; x <= 10; x++) {
        vec3 d = camera_ray(&c, vec2_make((float)x, 2)).direction;
        float want = tanf(35.0f * 3.14159265f / 180) * (float)(x - 5) / 5;
        TEST_ASSERT_FLOAT_WITHIN(1e-5f, want, d.x / -d.z);
    }
}

/* forward x up_reference is right; the reference need not be at right angles
 * to the view nor of length one. */
static void the_frame_follows_ref_up(void)
{
    struct camera_settings settings = {
        {10, 0, 0}, {0, 0, 0}, {-3, 0, 0.25f}, 90};
    struct film_settings film = {
        .width = 10, .height = 10, .filter_radius = 0.5f};
    struct camera c = camera_make(&settings, &film);
    expect_ray(&c, 5, 5, vec3_make(-1, 0, 0), "forward");
    expect_ray(&c, 5, 0, vec3_make(-1, 0, 1), "up is +z");
    expect_ray(&c, 10, 5, vec3_make(-1, 1, 0), "right is +y");
}

static void a_new_film_is_black(void)
{
    struct film film = film_make(3, 2, false);
    struct image image = film_develop(&film, 0, 0, 3, 2);
    for (int i = 0; i < 6; i++)
        TEST_ASSERT_TRUE(rgb_is_black(image.pixels[i]));
    image_free(&image);
    film_free(&film);
}

static void a_pixel_is_the_mean_of_its_samples(void)
{
    struct film film = film_make(1, 1, false);
    film_add(film.pixels, rgb_make(1, 2, 3), 1.0f);
    film_add(film.pixels, rgb_make(2, 2, 0), 1.0f);
    film_add(film.pixels, rgb_make(6, 2, 0), 1.0f);
    struct image image = film_develop(&film, 0, 0, 1, 1);
    TEST_ASSERT_EQUAL_FLOAT(3, image.pixels[0].r);
    TEST_ASSERT_EQUAL_FLOAT(2, image.pixels[0].g);
    TEST_ASSERT_EQUAL_FLOAT(1, image.pixels[0].b);
    image_free(&image);
    film_free(&film);
}

/* 2^25 times the same number: a float sum would stop at 2^24. */
static void many_samples_are_not_lost(void)
{
    struct film film = film_make(1, 1, false);
    for (long i = 0; i < 1L << 25; i++)
        film_add(film.pixels, rgb_grey(1), 1.0f);
    struct image image = film_develop(&film, 0, 0, 1, 1);
    TEST_ASSERT_EQUAL_FLOAT(1, image.pixels[0].r);
    image_free(&image);
    film_free(&film);
}

static void a_window_of_the_film_is_cut_out(void)
{
    struct film film = film_make(5, 4, false);
    for (int i = 0; i < 20; i++)
        film_add(&film.pixels[i], rgb_grey((float)i), 1.0f);
    struct image image = film_develop(&film, 1, 2, 4, 4);
    TEST_ASSERT_EQUAL_INT(3, image.width);
    TEST_ASSERT_EQUAL_INT(2, image.height);
    const float want[6] = {11, 12, 13, 16, 17, 18};
    for (int i = 0; i < 6; i++)
        TEST_ASSERT_EQUAL_FLOAT(want[i], image.pixels[i].g);
    image_free(&image);
    film_free(&film);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(the_centre_looks_forward);
    RUN_TEST(the_corners_span_the_field_of_view);
    RUN_TEST(y_runs_down);
    RUN_TEST(fov_is_vertical);
    RUN_TEST(fov_is_in_degrees);
    RUN_TEST(rays_have_length_one);
    RUN_TEST(straight_lines_stay_straight);
    RUN_TEST(the_frame_follows_ref_up);
    RUN_TEST(a_new_film_is_black);
    RUN_TEST(a_pixel_is_the_mean_of_its_samples);
    RUN_TEST(many_samples_are_not_lost);
    RUN_TEST(a_window_of_the_film_is_cut_out);
    return UNITY_END();
}
