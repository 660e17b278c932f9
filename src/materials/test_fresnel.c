/* test_fresnel.c - reflectances against theory in double precision. */
#include "materials/fresnel.h"

#include <complex.h>
#include <math.h>

#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static const double etas[] = {0.4, 0.75, 1.0001, 1.33, 1.5, 2.4};
enum { ETAS = sizeof etas / sizeof *etas };

static void straight_on(void)
{
    for (int k = 0; k < ETAS; k++) {
        double r = (etas[k] - 1.0) / (etas[k] + 1.0);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, r * r,
                                  fresnel_dielectric(1.0f, (float)etas[k]));
    }
    TEST_ASSERT_FLOAT_WITHIN(1e-7f, 0.04f, fresnel_dielectric(1.0f, 1.5f));
}

/* At Brewster's angle, whose tangent is eta, light polarised in the plane is
 * not reflected at all. */
static void at_brewsters_angle(void)
{
    for (int k = 0; k < ETAS; k++) {
        double eta2 = etas[k] * etas[k], cosine = 1.0 / sqrt(1.0 + eta2);
        double r = (1.0 - eta2) / (1.0 + eta2);
        TEST_ASSERT_DOUBLE_WITHIN(
            2e-6, 0.5 * r * r,
            fresnel_dielectric((float)cosine, (float)etas[k]));
    }
}

static void beyond_the_critical_angle_and_grazing(void)
{
    float critical = sqrtf(1.0f - 1.0f / (1.5f * 1.5f));
    float eta = 1.0f / 1.5f;
    TEST_ASSERT_EQUAL_FLOAT(1.0f, fresnel_dielectric(critical - 1e-5f, eta));
    TEST_ASSERT_EQUAL_FLOAT(1.0f, fresnel_dielectric(0.1f, eta));
    TEST_ASSERT_TRUE(fresnel_dielectric(critical + 1e-5f, eta) < 0.99f);
    TEST_ASSERT_EQUAL_FLOAT(1.0f, fresnel_dielectric(0.0f, 1.5f));
    TEST_ASSERT_EQUAL_FLOAT(1.0f, fresnel_dielectric(0.0f, 1.0f));
    TEST_ASSERT_EQUAL_FLOAT(1.0f, fresnel_conductor(0.0f, 1.0f, 0.0f));
}

/* What is transmitted, by its own formula: power through a boundary goes with
 * index and cosine. */
static double transmitted(double cosine, double eta)
{
    double beyond = sqrt(1.0 - (1.0 - cosine * cosine) / (eta * eta));
    double across = 2.0 * cosine / (cosine + eta * beyond);
    double in_plane = 2.0 * cosine / (eta * cosine + beyond);
    return eta * beyond / cosine * 0.5 *
           (across * across + in_plane * in_plane);
}

static void all_light_is_reflected_or_transmitted(void)
{
    for (int k = 0; k < ETAS; k++)
        for (int i = 1; i <= 1000; i++) {
            double cosine = (float)i / 1000.0f, eta = (float)etas[k];
            double reflected = fresnel_dielectric((float)cosine, (float)eta);
            if ((1.0 - cosine * cosine) / (eta * eta) > 0.99999)
                continue;
            TEST_ASSERT_DOUBLE_WITHIN(2e-5, 1.0,
                                      reflected + transmitted(cosine, eta));
        }
}

/* The cosine inside is near that of the critical angle, where a rounding
 * weighs the more, the smaller the cosine outside. */
static void the_same_from_either_side(void)
{
    for (int i = 1; i <= 1000; i++) {
        float cosine = (float)i / 1000.0f;
        float sine2 = (1.0f - cosine * cosine) / (1.5f * 1.5f);
        float beyond = sqrtf(1.0f - sine2);
        TEST_ASSERT_FLOAT_WITHIN(2e-6f / cosine,
                                 fresnel_dielectric(cosine, 1.5f),
                                 fresnel_dielectric(beyond, 1.0f / 1.5f));
    }
}

/* The dielectric's equations with a complex index. */
static double by_complex_numbers(double cosine, double eta, double k)
{
    double complex n = eta + k * I;
    double complex beyond = csqrt(1.0 - (1.0 - cosine * cosine) / (n * n));
    double across = cabs((cosine - n * beyond) / (cosine + n * beyond));
    double in_plane = cabs((n * cosine - beyond) / (n * cosine + beyond));
    return 0.5 * (across * across + in_plane * in_plane);
}

static void metals_follow_the_complex_equations(void)
{
    static const double index[][2] = {
        {0.1433, 3.703}, {0.338, 2.549}, {1.492, 1.908}, {0.05, 7.0},
        {3.0, 0.01},     {1.01, 0.1},    {4.0, 4.0},     {1.5, 0.0}};
    for (int m = 0; m < 8; m++)
        for (int i = 1; i <= 1000; i++) {
            double cosine = (float)i / 1000.0f;
            double eta = (float)index[m][0], k = (float)index[m][1];
            TEST_ASSERT_DOUBLE_WITHIN(
                5e-6, by_complex_numbers(cosine, eta, k),
                fresnel_conductor((float)cosine, (float)eta, (float)k));
        }
}

/* Gold at 650, 550 and 450 nm, with the index that D. Yakubovsky et al.,
 * "Optical constants and structural properties of thin gold films", Optics
 * Express 25, 2017, give for a film of 117 nm: red and yellow are reflected,
 * blue is not. */
static void gold_is_golden(void)
{
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, 0.9618f,
                             fresnel_conductor(1.0f, 0.1433f, 3.7030f));
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, 0.8368f,
                             fresnel_conductor(1.0f, 0.33819f, 2.54904f));
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, 0.3943f,
                             fresnel_conductor(1.0f, 1.49179f, 1.90836f));
}

static void a_metal_that_absorbs_nothing_is_glass(void)
{
    for (int i = 1; i <= 1000; i++) {
        float cosine = (float)i / 1000.0f;
        TEST_ASSERT_FLOAT_WITHIN(2e-6f, fresnel_dielectric(cosine, 1.5f),
                                 fresnel_conductor(cosine, 1.5f, 0.0f));
    }
}

static void every_share_is_from_0_to_1(void)
{
    for (int i = 0; i <= 1000; i++)
        for (int k = 0; k <= 40; k++)
            for (int m = 0; m <= 40; m++) {
                float cosine = (float)i / 1000.0f;
                float eta = 0.2f * (float)k, extinction = 0.2f * (float)m;
                float metal = fresnel_conductor(cosine, eta, extinction);
                float glass = fresnel_dielectric(cosine, eta + 0.1f);
                TEST_ASSERT_TRUE(metal >= 0.0f && metal <= 1.0f);
                TEST_ASSERT_TRUE(glass >= 0.0f && glass <= 1.0f);
            }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(straight_on);
    RUN_TEST(at_brewsters_angle);
    RUN_TEST(beyond_the_critical_angle_and_grazing);
    RUN_TEST(all_light_is_reflected_or_transmitted);
    RUN_TEST(the_same_from_either_side);
    RUN_TEST(metals_follow_the_complex_equations);
    RUN_TEST(gold_is_golden);
    RUN_TEST(a_metal_that_absorbs_nothing_is_glass);
    RUN_TEST(every_share_is_from_0_to_1);
    return UNITY_END();
}
