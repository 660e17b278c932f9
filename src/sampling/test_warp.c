/* test_warp.c - every warp follows its density. */
#include "sampling/warp.h"

#include "base/constants.h"
#include "sampling/test_density.h"
#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static void expect_fit(struct density_test test)
{
    struct density_result r = density_compare(&test);
    TEST_ASSERT_EQUAL_INT_MESSAGE(0, r.outside, "samples outside the domain");
    TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(2e-3, 1.0, r.integral,
                                      "the density integrates to one");
    TEST_ASSERT_TRUE_MESSAGE(r.chi_squared < r.limit,
                             "the samples follow the density");
}

/* Directions, all around or above the plane, in cells of equal solid angle. */
static struct density_test over_directions(double one_minus_cosine)
{
    struct density_test test = {.axis = vec3_make(0.0f, 0.0f, 1.0f),
                                .one_minus_cosine = one_minus_cosine,
                                .rows = 20,
                                .columns = 40,
                                .subdivisions = 4,
                                .samples = 200000};
    return test;
}

static struct density_test over_square(float lower, float upper)
{
    struct density_test test = {.lower = vec2_make(lower, lower),
                                .upper = vec2_make(upper, upper),
                                .rows = 20,
                                .columns = 20,
                                .subdivisions = 40,
                                .samples = 200000};
    return test;
}

static bool disk(const void *context, vec2 random, vec3 *point)
{
    (void)context;
    vec2 p = warp_disk(random);
    *point = vec3_make(p.x, p.y, 0.0f);
    return true;
}

static double disk_pdf(const void *context, vec3 p)
{
    (void)context;
    return warp_disk_pdf(vec2_make(p.x, p.y));
}

static void the_disk_fits(void)
{
    struct density_test test = over_square(-1.0f, 1.0f);
    test.sample = disk;
    test.pdf = disk_pdf;
    expect_fit(test);
}

static bool sphere(const void *context, vec2 random, vec3 *point)
{
    (void)context;
    *point = warp_sphere(random);
    return true;
}

static double sphere_pdf(const void *context, vec3 p)
{
    (void)context;
    return warp_sphere_pdf(p);
}

static void the_sphere_fits(void)
{
    struct density_test test = over_directions(2.0);
    test.sample = sphere;
    test.pdf = sphere_pdf;
    expect_fit(test);
}

static bool hemisphere(const void *context, vec2 random, vec3 *point)
{
    (void)context;
    *point = warp_hemisphere(random);
    return true;
}

static double hemisphere_pdf(const void *context, vec3 p)
{
    (void)context;
    return warp_hemisphere_pdf(p);
}

static void the_hemisphere_fits(void)
{
    struct density_test test = over_directions(2.0);
    test.sample = hemisphere;
    test.pdf = hemisphere_pdf;
    expect_fit(test);
}

static bool cosine(const void *context, vec2 random, vec3 *point)
{
    (void)context;
    *point = warp_cosine_hemisphere(random);
    return true;
}

static double cosine_pdf(const void *context, vec3 p)
{
    (void)context;
    return warp_cosine_hemisphere_pdf(p);
}

static void the_cosine_hemisphere_fits(void)
{
    struct density_test test = over_directions(2.0);
    test.sample = cosine;
    test.pdf = cosine_pdf;
    expect_fit(test);
}

static bool cone(const void *context, vec2 random, vec3 *point)
{
    *point = warp_cone(random, *(const float *)context);
    return true;
}

static double cone_pdf(const void *context, vec3 p)
{
    return warp_cone_pdf(p, *(const float *)context);
}

/* Half a degree across, as wide as the sun, and far narrower. */
static void cones_fit_however_narrow(void)
{
    const float heights[] = {1.5f, 0.3f, 9.5e-6f, 1e-10f};
    for (int i = 0; i < 4; i++) {
        struct density_test test = over_directions(heights[i] * 1.000002);
        test.sample = cone;
        test.pdf = cone_pdf;
        test.context = &heights[i];
        expect_fit(test);
    }
}

static bool triangle(const void *context, vec2 random, vec3 *point)
{
    (void)context;
    vec2 p = warp_triangle(random);
    *point = vec3_make(p.x, p.y, 0.0f);
    return true;
}

static double triangle_pdf(const void *context, vec3 p)
{
    (void)context;
    return warp_triangle_pdf(vec2_make(p.x, p.y));
}

/* Half of the cells on the diagonal are outside: many places in each. */
static void the_triangle_fits(void)
{
    struct density_test test = over_square(0.0f, 1.0f);
    test.sample = triangle;
    test.pdf = triangle_pdf;
    test.subdivisions = 199;
    expect_fit(test);
}

static bool bilinear(const void *context, vec2 random, vec3 *point)
{
    vec2 p = warp_bilinear(random, context);
    *point = vec3_make(p.x, p.y, 0.0f);
    return true;
}

static double bilinear_pdf(const void *context, vec3 p)
{
    return warp_bilinear_pdf(vec2_make(p.x, p.y), context);
}

static void bilinear_blends_fit(void)
{
    static const float corners[][4] = {
        {1, 2, 3, 4}, {0, 0, 0, 1}, {1, 0, 0, 1},        {0, 5, 0, 5},
        {3, 3, 3, 3}, {0, 0, 0, 0}, {1e-9f, 1, 1e9f, 0}, {0, 0, 2, 0}};
    for (int i = 0; i < 8; i++) {
        struct density_test test = over_square(0.0f, 1.0f);
        test.sample = bilinear;
        test.pdf = bilinear_pdf;
        test.context = corners[i];
        test.subdivisions = 8;
        expect_fit(test);
    }
}

/* The corners of the unit square, as near as numbers in [0, 1) come, map to
 * finite points of the domain. */
static void the_ends_of_the_range_are_safe(void)
{
    static const float corners[4] = {0, 0, 0, 1};
    const float ends[] = {0.0f, 0x1p-24f, 0.5f, ONE_MINUS_EPSILON};
    for (int i = 0; i < 16; i++) {
        vec2 random = vec2_make(ends[i % 4], ends[i / 4]);
        vec2 d = warp_disk(random), t = warp_triangle(random);
        vec2 b = warp_bilinear(random, corners);
        TEST_ASSERT_TRUE(d.x * d.x + d.y * d.y <= 1.000001f);
        TEST_ASSERT_TRUE(t.x >= 0.0f && t.y >= 0.0f && t.x + t.y <= 1.0f);
        TEST_ASSERT_TRUE(b.x >= 0.0f && b.x < 1.0f);
        TEST_ASSERT_TRUE(b.y >= 0.0f && b.y < 1.0f);
        TEST_ASSERT_FLOAT_WITHIN(1e-6f, 1.0f, vec3_length(warp_sphere(random)));
        TEST_ASSERT_FLOAT_WITHIN(1e-6f, 1.0f,
                                 vec3_length(warp_cosine_hemisphere(random)));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(the_disk_fits);
    RUN_TEST(the_sphere_fits);
    RUN_TEST(the_hemisphere_fits);
    RUN_TEST(the_cosine_hemisphere_fits);
    RUN_TEST(cones_fit_however_narrow);
    RUN_TEST(the_triangle_fits);
    RUN_TEST(bilinear_blends_fit);
    RUN_TEST(the_ends_of_the_range_are_safe);
    return UNITY_END();
}
