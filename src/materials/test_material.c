/* test_material.c - tests of material.h: the diffuse surface. */
#include "materials/material.h"

#include "base/constants.h"
#include "sampling/sampler.h"

#include "unity.h"

static const struct texture colour = {TEXTURE_CONSTANT, {0.8f, 0.5f, 0.25f}};
static const vec3 up = {0, 0, 1}, down = {0, 0, -1}, aslant = {0.6f, 0, 0.8f};
static const vec3 below = {0.6f, 0, -0.8f};

static struct material one_sided, two_sided;
static struct surface flat; /* in the plane z = 0, normal +z */

void setUp(void)
{
    one_sided = (struct material){MATERIAL_DIFFUSE, &colour, false};
    two_sided = (struct material){MATERIAL_DIFFUSE, &colour, true};
    flat = (struct surface){.geometric_normal = {0, 0, 1},
                            .shading_normal = {0, 0, 1}};
}

void tearDown(void)
{
}

static void expect_reflects(const struct material *m, vec3 outgoing,
                            vec3 incoming, const char *why)
{
    rgb f = material_eval(m, &flat, outgoing, incoming);
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(1e-7f, 0.8f / PI, f.r, why);
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(1e-7f, 0.5f / PI, f.g, why);
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(1e-7f, 0.25f / PI, f.b, why);
}

static void expect_black(const struct material *m, vec3 outgoing, vec3 incoming,
                         const char *why)
{
    TEST_ASSERT_TRUE_MESSAGE(
        rgb_is_black(material_eval(m, &flat, outgoing, incoming)), why);
}

static void diffuse_is_albedo_over_pi(void)
{
    expect_reflects(&one_sided, up, up, "straight");
    expect_reflects(&one_sided, aslant, up, "the same from every side");
    expect_reflects(&one_sided, up, aslant, "the same to every side");
}

static void one_side_is_black_from_behind(void)
{
    expect_black(&one_sided, up, below, "light from below");
    expect_black(&one_sided, below, up, "seen from below");
    expect_black(&one_sided, below, down, "both below");
}

static void two_sides_reflect_on_each_side(void)
{
    expect_reflects(&two_sided, up, aslant, "both above");
    expect_reflects(&two_sided, down, below, "both below");
    expect_black(&two_sided, up, below, "light does not pass through");
    expect_black(&two_sided, below, aslant, "nor the other way");
}

static void along_the_surface_is_black(void)
{
    expect_black(&one_sided, vec3_make(1, 0, 0), up, "seen edge on");
    expect_black(&two_sided, up, vec3_make(1, 0, 0), "lit edge on");
}

/* At the rim of a smooth mesh the two normals disagree about a direction:
 * light would leak through if only one of them were asked. */
static void both_normals_must_agree(void)
{
    flat.shading_normal = aslant;
    vec3 low = vec3_normalize(vec3_make(-1, 0, 0.5f));
    TEST_ASSERT_TRUE(vec3_dot(low, aslant) < 0);
    expect_black(&one_sided, up, low, "below the shading normal only");
    vec3 under = vec3_normalize(vec3_make(1, 0, -0.5f));
    TEST_ASSERT_TRUE(vec3_dot(under, aslant) > 0);
    expect_black(&one_sided, up, under, "below the geometric normal only");
    expect_reflects(&one_sided, up, up, "above both");
}

static void helmholtz_reciprocity(void)
{
    for (uint64_t i = 0; i < 1000; i++) {
        struct sampler s = sampler_start(0, 0, i);
        vec2 a = sampler_2d(&s), b = sampler_2d(&s);
        vec3 v = vec3_make(2 * a.x - 1, 2 * a.y - 1, sampler_1d(&s) - 0.3f);
        vec3 w = vec3_make(2 * b.x - 1, 2 * b.y - 1, sampler_1d(&s) - 0.3f);
        v = vec3_normalize(v), w = vec3_normalize(w);
        TEST_ASSERT_TRUE(material_eval(&two_sided, &flat, v, w).g ==
                         material_eval(&two_sided, &flat, w, v).g);
    }
}

/* The integral of the BSDF times the cosine over all directions is what is
 * reflected of white light from everywhere: the albedo. Midpoint rule. */
static void what_is_reflected_is_the_albedo(void)
{
    const int n = 200;
    double sum = 0.0;
    for (int i = 0; i < 2 * n; i++)
        for (int k = 0; k < 4 * n; k++) {
            double theta = (i + 0.5) * (double)PI / (2 * n);
            double phi = (k + 0.5) * (double)PI / (2 * n);
            vec3 d =
                vec3_make((float)(sin(theta) * cos(phi)),
                          (float)(sin(theta) * sin(phi)), (float)cos(theta));
            sum += (double)material_eval(&one_sided, &flat, aslant, d).r *
                   fabs(cos(theta)) * sin(theta);
        }
    double cell = (double)PI / (2 * n);
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, 0.8f, (float)(sum * cell * cell));
    TEST_ASSERT_EQUAL_FLOAT(0.8f, material_albedo(&one_sided, &flat).r);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(diffuse_is_albedo_over_pi);
    RUN_TEST(one_side_is_black_from_behind);
    RUN_TEST(two_sides_reflect_on_each_side);
    RUN_TEST(along_the_surface_is_black);
    RUN_TEST(both_normals_must_agree);
    RUN_TEST(helmholtz_reciprocity);
    RUN_TEST(what_is_reflected_is_the_albedo);
    return UNITY_END();
}
