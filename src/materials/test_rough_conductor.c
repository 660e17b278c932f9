/* test_rough_conductor.c - rough metal against Mitsuba, and its limits. The
 * properties that it shares with other materials are in test_material.c. */
#include "materials/rough_conductor.h"

#include "materials/ggx.h"
#include "materials/test_materials.h"
#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static struct material conductor(const struct texture *t, float ax, float ay)
{
    struct material m = {.kind = MATERIAL_ROUGH_CONDUCTOR,
                         .albedo = t,
                         .alpha_x = ax,
                         .alpha_y = ay,
                         .conductor_eta = {0.2f, 0.9f, 1.3f},
                         .conductor_k = {3.9f, 2.4f, 2.1f}};
    return m;
}

struct known {
    float alpha_x, alpha_y;
    vec3 outgoing, incoming;
    rgb bsdf;
    float pdf;
};

/* Figures of Mitsuba 3.9's roughconductor (scalar_rgb, ggx, visible normals)
 * for this material with a specular_reflectance of .9, .5, .7; its value
 * divided by the cosine of incoming, which Mitsuba includes. */
static const struct known mitsuba[] = {
    {0.1f,
     0.1f,
     {0.341881729f, -0.227921153f, 0.911684612f},
     {-0.254823596f, 0.305788315f, 0.917364945f},
     {4.142193f, 1.4886602f, 1.5711297f},
     4.4379463f},
    {0.1f,
     0.1f,
     {0.92998111f, 0.116247639f, 0.348742916f},
     {-0.866578245f, -0.247593784f, 0.433289122f},
     {2.3207963f, 0.87147005f, 0.97362064f},
     1.1971242f},
    {0.1f,
     0.1f,
     {0.0f, 0.832050294f, 0.554700196f},
     {0.104828484f, -0.943456353f, 0.314485451f},
     {2.3878524f, 0.88554965f, 0.97870209f},
     0.90321046f},
    {0.05f,
     0.4f,
     {0.341881729f, -0.227921153f, 0.911684612f},
     {-0.254823596f, 0.305788315f, 0.917364945f},
     {1.1095794f, 0.39877106f, 0.42086233f},
     1.1935593f},
    {0.05f,
     0.4f,
     {0.92998111f, 0.116247639f, 0.348742916f},
     {-0.866578245f, -0.247593784f, 0.433289122f},
     {1.6137101f, 0.60595578f, 0.67698373f},
     0.83620012f},
    {0.05f,
     0.4f,
     {0.0f, 0.832050294f, 0.554700196f},
     {0.104828484f, -0.943456353f, 0.314485451f},
     {0.31003909f, 0.1149799f, 0.12707483f},
     0.14696036f},
    {0.6f,
     0.2f,
     {0.341881729f, -0.227921153f, 0.911684612f},
     {-0.254823596f, 0.305788315f, 0.917364945f},
     {0.60636497f, 0.21792114f, 0.22999363f},
     0.65454358f},
    {0.6f,
     0.2f,
     {0.92998111f, 0.116247639f, 0.348742916f},
     {-0.866578245f, -0.247593784f, 0.433289122f},
     {0.72490559f, 0.2722055f, 0.30411244f},
     0.47470662f},
    {0.6f,
     0.2f,
     {0.0f, 0.832050294f, 0.554700196f},
     {0.104828484f, -0.943456353f, 0.314485451f},
     {1.4618708f, 0.54214373f, 0.59917275f},
     0.590455f},
};

static void the_values_are_mitsubas(void)
{
    struct texture t = constant_texture(rgb_make(0.9f, 0.5f, 0.7f));
    struct surface s =
        surface_with(vec3_make(0.0f, 0.0f, 1.0f), vec3_make(0.0f, 0.0f, 1.0f));
    s.dp_du = vec3_make(3.0f, 0.0f, 0.0f);
    for (size_t i = 0; i < sizeof mitsuba / sizeof *mitsuba; i++) {
        const struct known *k = &mitsuba[i];
        struct material m = conductor(&t, k->alpha_x, k->alpha_y);
        rgb f = material_eval(&m, &s, k->outgoing, k->incoming);
        float pdf = material_pdf(&m, &s, k->outgoing, k->incoming);
        TEST_ASSERT_FLOAT_WITHIN(1e-4f * k->bsdf.r, k->bsdf.r, f.r);
        TEST_ASSERT_FLOAT_WITHIN(1e-4f * k->bsdf.g, k->bsdf.g, f.g);
        TEST_ASSERT_FLOAT_WITHIN(1e-4f * k->bsdf.b, k->bsdf.b, f.b);
        TEST_ASSERT_FLOAT_WITHIN(1e-4f * k->pdf, k->pdf, pdf);
    }
}

/* The mirrors of a patch, seen from above, cover it exactly once; from any
 * other place those that are seen cover just what the patch does. */
static void the_mirrors_cover_the_surface(void)
{
    static const vec2 alphas[] = {{0.2f, 0.2f}, {0.15f, 0.6f}, {1.0f, 1.0f}};
    static const float angles[] = {0.0f, 0.8f, 1.4f};
    enum { STEPS = 600 };
    for (int c = 0; c < 9; c++) {
        vec2 alpha = alphas[c / 3];
        float angle = angles[c % 3];
        vec3 o = vec3_make(0.6f * sinf(angle), 0.8f * sinf(angle), cosf(angle));
        double area = 0.0, seen = 0.0, cell = 6.283185307 / STEPS / STEPS;
        for (int i = 0; i < STEPS * STEPS; i++) {
            float z = ((float)(i / STEPS) + 0.5f) / STEPS;
            float phi = 6.2831853f * (float)(i % STEPS) / STEPS;
            float r = sqrtf(1.0f - z * z);
            vec3 n = vec3_make(r * cosf(phi), r * sinf(phi), z);
            double density = ggx_density(alpha, n);
            area += cell * density * z;
            seen += cell * density * ggx_seen_over_cosine(alpha, o) *
                    fmaxf(0.0f, vec3_dot(o, n));
        }
        TEST_ASSERT_DOUBLE_WITHIN(2e-3, 1.0, area);
        TEST_ASSERT_DOUBLE_WITHIN(2e-3, 1.0, seen);
    }
}

/* A surface that is hardly rough is a mirror, and its axes follow u. */
static void smooth_metal_is_a_mirror(void)
{
    struct texture t = constant_texture(rgb_grey(1.0f));
    struct material m = conductor(&t, 0.001f, 0.001f);
    struct surface s = flat_surface();
    for (uint64_t i = 0; i < 1000; i++) {
        vec3 o = direction_at(&s, 1.4f * random_float(i, 0), 0.5f);
        const float random[3] = {random_float(i, 1), random_float(i, 2), 0.0f};
        struct scatter way;
        TEST_ASSERT_TRUE(material_sample(&m, &s, o, random, &way));
        vec3 half = vec3_normalize(vec3_add(o, way.incoming));
        if (random_float(i, 1) > 0.2f && random_float(i, 1) < 0.8f &&
            random_float(i, 2) > 0.2f && random_float(i, 2) < 0.8f)
            TEST_ASSERT_FLOAT_WITHIN(
                0.005f, 0.0f, vec3_length(vec3_sub(half, s.shading_normal)));
        TEST_ASSERT_TRUE(isfinite(way.pdf) && way.pdf > 0.0f);
        TEST_ASSERT_TRUE(way.weight.r > 0.5f && way.weight.r <= 1.0f);
    }
}

/* Rough across u and smooth along it: the normals tilt across. */
static void the_roughness_follows_the_texture(void)
{
    struct texture t = constant_texture(rgb_grey(1.0f));
    struct material m = conductor(&t, 0.01f, 0.5f);
    struct surface s = flat_surface();
    vec3 n = s.shading_normal;
    vec3 u = vec3_step(s.dp_du, -vec3_dot(s.dp_du, n), n);
    vec3 x = vec3_normalize(u), y = vec3_cross(n, x);
    double along = 0.0, across = 0.0;
    for (uint64_t i = 0; i < 1000; i++) {
        const float random[3] = {random_float(i, 1), random_float(i, 2), 0.0f};
        struct scatter way;
        if (!material_sample(&m, &s, n, random, &way))
            continue;
        vec3 half = vec3_normalize(vec3_add(n, way.incoming));
        along += fabsf(vec3_dot(half, x));
        across += fabsf(vec3_dot(half, y));
    }
    TEST_ASSERT_TRUE(across > 10.0 * along && along > 0.0);
}

static void there_is_an_answer_where_u_has_no_direction(void)
{
    struct texture t = constant_texture(rgb_grey(1.0f));
    struct material m = conductor(&t, 0.2f, 0.3f);
    struct surface s = flat_surface();
    const vec3 useless[] = {{0, 0, 0}, s.shading_normal, {1e-30f, 0, 0}};
    for (int i = 0; i < 3; i++) {
        struct scatter way;
        const float random[3] = {0.3f, 0.4f, 0.0f};
        s.dp_du = useless[i];
        vec3 o = direction_at(&s, 0.4f, 1.0f);
        TEST_ASSERT_TRUE(material_sample(&m, &s, o, random, &way));
        TEST_ASSERT_FLOAT_WITHIN(1e-6f, 1.0f, vec3_length(way.incoming));
        TEST_ASSERT_TRUE(isfinite(way.pdf) && isfinite(way.weight.r));
    }
}

/* Down to the last degree, where both numbers are at the ends of their range,
 * nothing overflows. */
static void grazing_light_is_finite(void)
{
    struct texture t = constant_texture(rgb_grey(1.0f));
    static const float ends[] = {0.0f, 0x1p-24f, 0.5f, 1.0f - 0x1p-24f};
    static const float alphas[] = {0.001f, 0.1f, 1.0f};
    struct surface s = flat_surface();
    for (float off = 1.5f; off > 1e-7f; off *= 0.3f)
        for (int i = 0; i < 16 * 9; i++) {
            struct material m =
                conductor(&t, alphas[i / 16 % 3], alphas[i / 48]);
            const float random[3] = {ends[i % 4], ends[i / 4 % 4], 0.0f};
            vec3 o = direction_at(&s, 1.57079633f - off, 0.7f);
            struct scatter way;
            if (!material_sample(&m, &s, o, random, &way))
                continue;
            rgb f = material_eval(&m, &s, o, way.incoming);
            TEST_ASSERT_TRUE(isfinite(way.pdf) && way.pdf > 0.0f);
            TEST_ASSERT_TRUE(isfinite(f.r) && f.r >= 0.0f);
            TEST_ASSERT_TRUE(way.weight.r >= 0.0f && way.weight.r <= 1.0f);
        }
}

/* Mirrors never face down, whatever rounding says. */
static void the_mirrors_face_up(void)
{
    for (uint64_t i = 0; i < 200000; i++) {
        vec2 alpha = vec2_make(0.001f + random_float(i, 0), 0.3f);
        vec2 random = vec2_make(i % 2 ? random_float(i, 1) : 0.5f, 0.0f);
        vec3 o =
            warp_hemisphere(vec2_make(random_float(i, 2), random_float(i, 3)));
        vec3 n = ggx_sample_seen(alpha, o, random);
        TEST_ASSERT_TRUE(n.z >= 0.0f);
        TEST_ASSERT_FLOAT_WITHIN(1e-6f, 1.0f, vec3_length(n));
    }
}

static void the_albedo_is_the_reflectance_straight_on(void)
{
    struct texture t = constant_texture(rgb_make(0.9f, 0.5f, 0.7f));
    struct surface s = flat_surface();
    struct material m = conductor(&t, 0.2f, 0.2f);
    float eta = m.conductor_eta.g, k = m.conductor_k.g;
    float straight =
        ((eta - 1) * (eta - 1) + k * k) / ((eta + 1) * (eta + 1) + k * k);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.5f * straight, material_albedo(&m, &s).g);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(the_values_are_mitsubas);
    RUN_TEST(the_mirrors_cover_the_surface);
    RUN_TEST(smooth_metal_is_a_mirror);
    RUN_TEST(the_roughness_follows_the_texture);
    RUN_TEST(there_is_an_answer_where_u_has_no_direction);
    RUN_TEST(grazing_light_is_finite);
    RUN_TEST(the_mirrors_face_up);
    RUN_TEST(the_albedo_is_the_reflectance_straight_on);
    return UNITY_END();
}
