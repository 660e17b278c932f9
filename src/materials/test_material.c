/* test_material.c - what holds for every material that has a density: sample,
 * eval and pdf tell the same story, and no light is made. */
#include "materials/material.h"

#include "base/constants.h"
#include "materials/test_materials.h"
#include "sampling/test_density.h"
#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static struct texture white;

/* Metal with a Fresnel reflectance of 1 whatever the angle. */
static struct material perfect_metal(float alpha_x, float alpha_y)
{
    struct material m = {.kind = MATERIAL_ROUGH_CONDUCTOR,
                         .albedo = &white,
                         .alpha_x = alpha_x,
                         .alpha_y = alpha_y,
                         .conductor_k = {1.0f, 1.0f, 1.0f}};
    return m;
}

static struct material diffuse(bool two_sided)
{
    struct material m = {
        .kind = MATERIAL_DIFFUSE, .albedo = &white, .two_sided = two_sided};
    return m;
}

/* A material on a surface, seen from somewhere. */
struct view {
    struct material material;
    struct surface surface;
    vec3 outgoing;
};

static const float roughness[][2] = {
    {0.15f, 0.15f}, {0.3f, 0.3f}, {1.0f, 1.0f}, {0.15f, 0.5f}, {0.7f, 0.2f}};
static const float angles[] = {0.0f, 0.7f, 1.1f, 1.4f};
enum { METALS = 5, ANGLES = 4, VIEWS = (METALS + 2) * ANGLES };

/* Five metals, a diffuse surface and one seen from behind, each from straight
 * on to grazing. */
static struct view some_view(int i, struct surface s)
{
    struct view v = {.surface = s};
    int material = i / ANGLES;
    if (material < METALS)
        v.material =
            perfect_metal(roughness[material][0], roughness[material][1]);
    else
        v.material = diffuse(material > METALS);
    v.outgoing = direction_at(&s, angles[i % ANGLES], 0.4f + (float)i);
    if (material > METALS)
        v.outgoing = vec3_negate(v.outgoing);
    return v;
}

/* ---- samples follow the density ---- */

static bool sample_view(const void *context, vec2 random, vec3 *point)
{
    const struct view *v = context;
    const float numbers[3] = {random.x, random.y, 0.5f};
    struct scatter way;
    if (!material_sample(&v->material, &v->surface, v->outgoing, numbers, &way))
        return false;
    *point = way.incoming;
    return true;
}

static double view_pdf(const void *context, vec3 point)
{
    const struct view *v = context;
    return material_pdf(&v->material, &v->surface, v->outgoing, point);
}

static struct density_test over_hemisphere(const struct view *v)
{
    vec3 n = v->surface.shading_normal;
    bool behind = vec3_dot(v->outgoing, n) < 0.0f;
    struct density_test test = {.context = v,
                                .sample = sample_view,
                                .pdf = view_pdf,
                                .axis = behind ? vec3_negate(n) : n,
                                .one_minus_cosine = 1.0,
                                .rows = 16,
                                .columns = 32,
                                .subdivisions = 8,
                                .samples = 100000};
    return test;
}

/* What the density lacks to one is the share of picks that fail. */
static struct density_result compare_view(struct density_test test)
{
    int samples = test.samples;
    test.samples = 0;
    double integral = density_compare(&test).integral;
    test.failed_share = fmax(0.0, 1.0 - integral);
    test.samples = samples;
    return density_compare(&test);
}

static void samples_follow_the_density(void)
{
    for (int i = 0; i < VIEWS; i++) {
        struct view v = some_view(i, flat_surface());
        struct density_result r = compare_view(over_hemisphere(&v));
        TEST_ASSERT_EQUAL_INT_MESSAGE(0, r.outside, "below the surface");
        TEST_ASSERT_TRUE_MESSAGE(r.integral < 1.002, "too much density");
        TEST_ASSERT_TRUE_MESSAGE(r.chi_squared < r.limit, "not the density");
    }
}

/* Nearly a mirror: the cells lie around the mirror direction, and what falls
 * outside of them counts as failed. */
static bool sample_near_mirror(const void *context, vec2 random, vec3 *point)
{
    const struct view *v = context;
    vec3 n = v->surface.shading_normal, o = v->outgoing;
    vec3 mirror = vec3_sub(vec3_scale(n, 2.0f * vec3_dot(n, o)), o);
    return sample_view(context, random, point) &&
           vec3_dot(*point, mirror) > 0.9951f;
}

static void samples_follow_a_narrow_density(void)
{
    for (int i = 0; i < 3; i++) {
        struct view v = some_view(i, flat_surface());
        vec3 n = v.surface.shading_normal, o = v.outgoing;
        v.material = perfect_metal(0.01f, i < 1 ? 0.01f : 0.03f);
        struct density_test test = over_hemisphere(&v);
        test.axis = vec3_sub(vec3_scale(n, 2.0f * vec3_dot(n, o)), o);
        test.one_minus_cosine = 0.0049;
        test.subdivisions = 24;
        test.sample = sample_near_mirror;
        struct density_result r = compare_view(test);
        TEST_ASSERT_TRUE(r.integral > 0.8);
        TEST_ASSERT_TRUE(r.chi_squared < r.limit);
    }
}

/* ---- a white furnace: radiance 1 from everywhere ---- */

struct furnace {
    double mean, deviation, failed; /* of the weights of samples */
    double reflected, density;      /* by quadrature of eval and of pdf */
};

static void furnace_by_samples(const struct view *v, struct furnace *out)
{
    enum { SAMPLES = 40000 };
    double sum = 0.0, squares = 0.0;
    for (uint64_t i = 0; i < SAMPLES; i++) {
        const float random[3] = {random_float(i, 0), random_float(i, 1), 0.0f};
        struct scatter way;
        if (!material_sample(&v->material, &v->surface, v->outgoing, random,
                             &way)) {
            out->failed += 1.0 / SAMPLES;
            continue;
        }
        sum += way.weight.g;
        squares += (double)way.weight.g * way.weight.g;
    }
    out->mean = sum / SAMPLES;
    out->deviation =
        sqrt(fmax(0.0, squares / SAMPLES - out->mean * out->mean) / SAMPLES);
}

static void furnace_by_quadrature(const struct view *v, struct furnace *out)
{
    enum { ROWS = 250, COLUMNS = 240 };
    struct density_test sphere = over_hemisphere(v);
    double cell = 2.0 * acos(-1.0) / (ROWS * COLUMNS);
    for (int i = 0; i < ROWS * COLUMNS; i++) {
        vec3 in = density_point(&sphere, (i % COLUMNS + 0.5) / COLUMNS,
                                (i / COLUMNS + 0.5) / ROWS);
        double cosine = fabsf(vec3_dot(in, v->surface.shading_normal));
        rgb f = material_eval(&v->material, &v->surface, v->outgoing, in);
        out->reflected += cell * f.g * cosine;
        out->density += cell * view_pdf(v, in);
    }
}

static struct furnace furnace(const struct view *v)
{
    struct furnace f = {0.0, 0.0, 0.0, 0.0, 0.0};
    furnace_by_samples(v, &f);
    furnace_by_quadrature(v, &f);
    return f;
}

/* Six deviations of the mean: wrong once in 1e9, and the seeds are fixed. */
static void expect_furnace(const struct view *v, double quadrature_error)
{
    struct furnace f = furnace(v);
    double tolerance = 6.0 * f.deviation + quadrature_error;
    double failures = 6.0 * sqrt(f.failed / 40000.0) + 2e-4;
    TEST_ASSERT_DOUBLE_WITHIN(tolerance, f.reflected, f.mean);
    TEST_ASSERT_DOUBLE_WITHIN(failures + quadrature_error, 1.0 - f.failed,
                              f.density);
    TEST_ASSERT_TRUE(f.mean <= 1.0 + 1e-6);
}

static void samples_and_values_agree_in_a_furnace(void)
{
    for (int i = 0; i < VIEWS; i++) {
        struct view v = some_view(i, flat_surface());
        expect_furnace(&v, 2e-3);
    }
}

/* The true surface cuts the hemisphere across the cells. */
static void they_agree_on_a_smooth_mesh_too(void)
{
    for (int i = 0; i < VIEWS; i++) {
        struct view v = some_view(i, smooth_surface());
        if (i % ANGLES < 2)
            expect_furnace(&v, 4e-3);
    }
}

static void white_paper_loses_nothing(void)
{
    for (int i = METALS * ANGLES; i < VIEWS; i++) {
        struct view v = some_view(i, flat_surface());
        struct furnace f = furnace(&v);
        TEST_ASSERT_DOUBLE_WITHIN(1e-3, 1.0, f.mean);
        TEST_ASSERT_DOUBLE_WITHIN(1e-3, 1.0, f.reflected);
    }
}

/* Only what one mirror sends to another is lost: little while it is smooth.
 * Figures of Mitsuba 3.9, +-0.001. */
static void metal_loses_only_what_is_masked(void)
{
    static const float known[][3] = {{0.02f, 0.5f, 0.9996f},
                                     {0.15f, 0.5f, 0.9672f},
                                     {0.3f, 1.2f, 0.8062f},
                                     {1.0f, 0.5f, 0.3267f}};
    struct surface s = flat_surface();
    for (int i = 0; i < 4; i++) {
        struct view v = {perfect_metal(known[i][0], known[i][0]), s,
                         direction_at(&s, known[i][1], 1.0f)};
        struct furnace f = {0.0, 0.0, 0.0, 0.0, 0.0};
        furnace_by_samples(&v, &f);
        TEST_ASSERT_DOUBLE_WITHIN(6.0 * f.deviation + 1e-3, known[i][2],
                                  f.mean);
    }
}

/* ---- one direction at a time ---- */

static void a_weight_is_value_times_cosine_over_density(void)
{
    const struct surface surfaces[] = {flat_surface(), smooth_surface()};
    for (int i = 0; i < VIEWS * 200; i++) {
        struct view v = some_view(i % VIEWS, surfaces[i / VIEWS % 2]);
        uint64_t key = (uint64_t)i;
        const float random[3] = {random_float(key, 0), random_float(key, 1),
                                 random_float(key, 2)};
        struct scatter way;
        if (!material_sample(&v.material, &v.surface, v.outgoing, random, &way))
            continue;
        rgb f =
            material_eval(&v.material, &v.surface, v.outgoing, way.incoming);
        float pdf =
            material_pdf(&v.material, &v.surface, v.outgoing, way.incoming);
        float cosine = fabsf(vec3_dot(way.incoming, v.surface.shading_normal));
        TEST_ASSERT_EQUAL_FLOAT(pdf, way.pdf);
        TEST_ASSERT_FLOAT_WITHIN(2e-4f, f.g * cosine / pdf, way.weight.g);
        TEST_ASSERT_FLOAT_WITHIN(1e-6f, 1.0f, vec3_length(way.incoming));
        TEST_ASSERT_FALSE(way.specular || way.transmitted);
    }
}

static void light_may_go_either_way(void)
{
    const struct surface surfaces[] = {flat_surface(), smooth_surface()};
    int lit = 0;
    for (int i = 0; i < VIEWS * 400; i++) {
        struct view v = some_view(i % VIEWS, surfaces[i / VIEWS % 2]);
        vec3 a = some_direction(2 * (uint64_t)i);
        vec3 b = some_direction(2 * (uint64_t)i + 1);
        float there = material_eval(&v.material, &v.surface, a, b).g;
        float back = material_eval(&v.material, &v.surface, b, a).g;
        TEST_ASSERT_FLOAT_WITHIN(1e-5f + 1e-5f * there, there, back);
        lit += there > 0.0f;
    }
    TEST_ASSERT_TRUE(lit > 1000);
}

/* The value of a material for directions at angles to the normal; over 90
 * degrees: from behind. */
static float value(struct material m, float out_angle, float in_angle)
{
    struct surface s = flat_surface();
    vec3 o = direction_at(&s, out_angle, 0.0f);
    vec3 i = direction_at(&s, in_angle, 1.0f);
    float pdf = material_pdf(&m, &s, o, i);
    float f = material_eval(&m, &s, o, i).g;
    TEST_ASSERT_EQUAL(f > 0.0f, pdf > 0.0f);
    return f;
}

static void only_two_sided_paper_reflects_behind(void)
{
    struct material one = diffuse(false), both = diffuse(true);
    struct material metal = perfect_metal(0.5f, 0.5f);
    TEST_ASSERT_FLOAT_WITHIN(1e-7f, 1.0f / PI, value(one, 0.5f, 1.0f));
    TEST_ASSERT_FLOAT_WITHIN(1e-7f, 1.0f / PI, value(both, 0.5f, 1.0f));
    TEST_ASSERT_FLOAT_WITHIN(1e-7f, 1.0f / PI, value(both, 2.5f, 2.0f));
    TEST_ASSERT_TRUE(value(metal, 0.5f, 1.0f) > 0.0f);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, value(one, 2.5f, 2.0f));
    TEST_ASSERT_EQUAL_FLOAT(0.0f, value(metal, 2.5f, 2.0f));
    for (int i = 0; i < 2; i++) { /* nothing passes through */
        float out = i ? 2.5f : 0.5f, in = i ? 0.5f : 2.5f;
        TEST_ASSERT_EQUAL_FLOAT(0.0f, value(one, out, in));
        TEST_ASSERT_EQUAL_FLOAT(0.0f, value(both, out, in));
        TEST_ASSERT_EQUAL_FLOAT(0.0f, value(metal, out, in));
    }
}

/* No light from behind the true surface, nor from behind the smooth one. */
static void nothing_leaks_at_the_rim(void)
{
    struct surface s = smooth_surface();
    for (int k = 0; k < 3; k++) {
        struct material m = k == 2 ? perfect_metal(1, 1) : diffuse(k == 1);
        for (uint64_t i = 0; i < 4000; i++) {
            vec3 a = some_direction(i), b = some_direction(i + 4000);
            float ag = vec3_dot(a, s.geometric_normal);
            float as = vec3_dot(a, s.shading_normal);
            float bg = vec3_dot(b, s.geometric_normal);
            float bs = vec3_dot(b, s.shading_normal);
            bool front = ag > 0 && as > 0 && bg > 0 && bs > 0;
            bool back = ag < 0 && as < 0 && bg < 0 && bs < 0;
            bool lit = front || (back && m.two_sided);
            TEST_ASSERT_EQUAL(lit, material_eval(&m, &s, a, b).g > 0.0f);
            TEST_ASSERT_EQUAL(lit, material_pdf(&m, &s, a, b) > 0.0f);
        }
    }
}

static void the_texture_tints(void)
{
    struct texture red = constant_texture(rgb_make(0.8f, 0.4f, 0.0f));
    struct surface s = flat_surface();
    struct material m = diffuse(false);
    m.albedo = &red;
    vec3 o = direction_at(&s, 0.5f, 0.0f), i = direction_at(&s, 1.0f, 1.0f);
    const float random[3] = {0.3f, 0.6f, 0.0f};
    struct scatter way;
    TEST_ASSERT_FLOAT_WITHIN(1e-7f, 0.8f / PI, material_eval(&m, &s, o, i).r);
    TEST_ASSERT_TRUE(material_sample(&m, &s, o, random, &way));
    TEST_ASSERT_EQUAL_FLOAT(0.4f, way.weight.g);
    TEST_ASSERT_EQUAL_FLOAT(0.8f, material_albedo(&m, &s).r);
    TEST_ASSERT_FALSE(material_is_specular(&m));
}

int main(void)
{
    white = constant_texture(rgb_grey(1.0f));
    UNITY_BEGIN();
    RUN_TEST(samples_follow_the_density);
    RUN_TEST(samples_follow_a_narrow_density);
    RUN_TEST(samples_and_values_agree_in_a_furnace);
    RUN_TEST(they_agree_on_a_smooth_mesh_too);
    RUN_TEST(white_paper_loses_nothing);
    RUN_TEST(metal_loses_only_what_is_masked);
    RUN_TEST(a_weight_is_value_times_cosine_over_density);
    RUN_TEST(light_may_go_either_way);
    RUN_TEST(only_two_sided_paper_reflects_behind);
    RUN_TEST(nothing_leaks_at_the_rim);
    RUN_TEST(the_texture_tints);
    return UNITY_END();
}
