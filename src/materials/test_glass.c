/* test_glass.c - glass and perfect refraction: energy, sides, weights. */
#include "materials/material.h"

#include "materials/fresnel.h"
#include "materials/refraction.h"
#include "materials/test_materials.h"
#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static struct material clear_material(enum material_kind kind, float eta)
{
    struct material m = {.kind = kind, .eta = eta};
    m.reflectance = m.transmittance = rgb_grey(1.0f);
    return m;
}

/* In an oven in which everything is as hot, radiance is the square of the
 * index: 1 outside, eta^2 inside. Glass must not change that. The share is
 * counted by stepping random[2] evenly from 0 to 1. */
static double oven(const struct material *m, const struct surface *s, vec3 o)
{
    enum { STEPS = 4096 };
    double sum = 0.0, inside = (double)m->eta * m->eta;
    double here = vec3_dot(o, s->geometric_normal) >= 0.0f ? 1.0 : inside;
    double beyond = here == 1.0 ? inside : 1.0;
    for (int i = 0; i < STEPS; i++) {
        struct scatter way;
        const float random[3] = {0.3f, 0.6f, ((float)i + 0.5f) / STEPS};
        if (material_sample(m, s, o, random, &way))
            sum += way.weight.g * (way.transmitted ? beyond : here);
    }
    return sum / (here * STEPS);
}

/* 1.05: where the two normals disagree, light still passes. */
static void glass_keeps_an_oven_even(void)
{
    static const float etas[] = {1.5f, 0.7f, 1.05f};
    const struct surface surfaces[] = {flat_surface(), smooth_surface()};
    for (uint64_t i = 0; i < 300; i++) {
        struct material m = clear_material(MATERIAL_GLASS, etas[i % 3]);
        vec3 o = some_direction(i);
        TEST_ASSERT_DOUBLE_WITHIN(1e-5, 1.0, oven(&m, &surfaces[i % 2], o));
    }
}

/* R and T weigh the Fresnel shares, from both sides. */
static void the_shares_are_fresnels(void)
{
    struct surface s = flat_surface();
    struct material m = clear_material(MATERIAL_GLASS, 1.5f);
    m.transmittance = rgb_grey(0.0f);
    for (int i = 1; i < 90; i++) {
        float angle = (float)i * 0.0174533f;
        double out = oven(&m, &s, direction_at(&s, angle, 1.0f));
        double in = oven(&m, &s, direction_at(&s, 3.14159265f - angle, 1.0f));
        TEST_ASSERT_DOUBLE_WITHIN(3e-4, fresnel_dielectric(cosf(angle), 1.5f),
                                  out);
        TEST_ASSERT_DOUBLE_WITHIN(
            3e-4, fresnel_dielectric(cosf(angle), 1.0f / 1.5f), in);
    }
}

static void a_colour_tints_its_own_part(void)
{
    struct surface s = flat_surface();
    struct material m = clear_material(MATERIAL_GLASS, 1.5f);
    m.reflectance = rgb_make(0.1f, 0.2f, 0.3f);
    m.transmittance = rgb_make(0.9f, 0.6f, 0.3f);
    struct scatter way;
    const float first[3] = {0.0f, 0.0f, 0.0f}, last[3] = {0.5f, 0.5f, 0.99f};
    vec3 o = direction_at(&s, 0.5f, 0.0f);
    TEST_ASSERT_TRUE(material_sample(&m, &s, o, first, &way));
    TEST_ASSERT_FALSE(way.transmitted);
    TEST_ASSERT_EQUAL_FLOAT(0.2f, way.weight.g);
    TEST_ASSERT_TRUE(material_sample(&m, &s, o, last, &way));
    TEST_ASSERT_TRUE(way.transmitted);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.6f / 2.25f, way.weight.g);
    /* Out again the factor is turned round: in and out cancel. */
    o = direction_at(&s, 2.9f, 0.0f);
    TEST_ASSERT_TRUE(material_sample(&m, &s, o, last, &way));
    TEST_ASSERT_TRUE(way.transmitted);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.6f * 2.25f, way.weight.g);
}

static void perfect_refraction_only_turns(void)
{
    struct surface s = flat_surface();
    struct material m = clear_material(MATERIAL_REFRACTION, 1.5f);
    for (uint64_t i = 0; i < 1000; i++) {
        vec3 o = some_direction(i), expected;
        struct scatter way;
        const float random[3] = {0.1f, 0.2f, 0.0f};
        bool passes =
            refraction_direction(s.geometric_normal, o, 1.5f, &expected);
        TEST_ASSERT_TRUE(material_sample(&m, &s, o, random, &way));
        TEST_ASSERT_EQUAL(passes, way.transmitted);
        TEST_ASSERT_TRUE(way.specular);
        TEST_ASSERT_EQUAL_FLOAT(0.0f, way.pdf);
        TEST_ASSERT_EQUAL_FLOAT(1.0f, way.weight.r);
        TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.0f,
                                 vec3_length(vec3_sub(expected, way.incoming)));
    }
}

/* Whatever the normals say, what passes ends beyond the true surface and what
 * is reflected does not; and a direction on which they agree is turned about
 * the smooth one. */
static void the_true_surface_decides_the_side(void)
{
    struct surface s = smooth_surface();
    int smooth = 0;
    for (uint64_t i = 0; i < 20000; i++) {
        vec3 o = some_direction(i), n = s.geometric_normal, expected;
        struct material m = clear_material(
            i % 2 ? MATERIAL_GLASS : MATERIAL_REFRACTION, i % 3 ? 1.5f : 0.6f);
        struct scatter way;
        const float random[3] = {0.0f, 0.0f, random_float(i, 9)};
        TEST_ASSERT_TRUE(material_sample(&m, &s, o, random, &way));
        bool crossed = (vec3_dot(o, n) > 0) != (vec3_dot(way.incoming, n) > 0);
        if (fabsf(vec3_dot(o, n)) > 1e-6f &&
            fabsf(vec3_dot(way.incoming, n)) > 1e-6f)
            TEST_ASSERT_EQUAL(way.transmitted, crossed);
        TEST_ASSERT_FLOAT_WITHIN(1e-6f, 1.0f, vec3_length(way.incoming));
        refraction_direction(s.shading_normal, o, m.eta, &expected);
        if (way.transmitted &&
            vec3_length(vec3_sub(expected, way.incoming)) < 1e-6f)
            smooth++;
    }
    TEST_ASSERT_TRUE(smooth > 5000);
}

static void specular_materials_have_no_density(void)
{
    struct surface s = flat_surface();
    vec3 o = direction_at(&s, 0.4f, 0.0f), in;
    for (int kind = 0; kind < 2; kind++) {
        struct material m =
            clear_material(kind ? MATERIAL_GLASS : MATERIAL_REFRACTION, 1.5f);
        refraction_direction(s.geometric_normal, o, 1.5f, &in);
        TEST_ASSERT_TRUE(material_is_specular(&m));
        TEST_ASSERT_TRUE(rgb_is_black(material_eval(&m, &s, o, in)));
        TEST_ASSERT_EQUAL_FLOAT(0.0f, material_pdf(&m, &s, o, in));
        TEST_ASSERT_EQUAL_FLOAT(1.0f, material_albedo(&m, &s).b);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(glass_keeps_an_oven_even);
    RUN_TEST(the_shares_are_fresnels);
    RUN_TEST(a_colour_tints_its_own_part);
    RUN_TEST(perfect_refraction_only_turns);
    RUN_TEST(the_true_surface_decides_the_side);
    RUN_TEST(specular_materials_have_no_density);
    return UNITY_END();
}
