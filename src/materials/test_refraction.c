/* test_refraction.c - Snell's law against double precision. */
#include "materials/refraction.h"

#include "materials/test_materials.h"
#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

struct exact {
    double cosine2_beyond, x, y, z;
};

/* From the same floats, by the sines. */
static struct exact snell(vec3 n, vec3 o, double eta)
{
    double nn = (double)n.x * n.x + (double)n.y * n.y + (double)n.z * n.z;
    double oo = (double)o.x * o.x + (double)o.y * o.y + (double)o.z * o.z;
    double k = 1.0 / sqrt(nn), l = 1.0 / sqrt(oo);
    double nx = k * n.x, ny = k * n.y, nz = k * n.z;
    double ox = l * o.x, oy = l * o.y, oz = l * o.z;
    double cosine = nx * ox + ny * oy + nz * oz;
    double ratio = cosine >= 0.0 ? 1.0 / eta : eta;
    double side = cosine >= 0.0 ? 1.0 : -1.0;
    double px = ox - cosine * nx, py = oy - cosine * ny, pz = oz - cosine * nz;
    double sine2 = ratio * ratio * (px * px + py * py + pz * pz);
    double down = side * sqrt(fmax(0.0, 1.0 - sine2));
    struct exact e = {1.0 - sine2, -ratio * px - down * nx,
                      -ratio * py - down * ny, -ratio * pz - down * nz};
    if (sine2 > 1.0) {
        e.x = cosine * nx - px;
        e.y = cosine * ny - py;
        e.z = cosine * nz - pz;
    }
    return e;
}

/* A rounding in the squared cosine weighs more the nearer it is to 0; so near
 * that the sign may be lost, either answer is right. */
static void expect_snell(vec3 n, vec3 o, float eta)
{
    vec3 in;
    struct exact e = snell(n, o, eta);
    double ratio = fmax(eta, 1.0 / eta), unsure = 4e-7 * (1.0 + ratio * ratio);
    bool passes = refraction_direction(n, o, eta, &in);
    TEST_ASSERT_FLOAT_WITHIN(5e-7f, 1.0f, vec3_length(in));
    if (fabs(e.cosine2_beyond) < unsure)
        return;
    TEST_ASSERT_EQUAL(e.cosine2_beyond > 0.0, passes);
    double tolerance = 1e-6 + unsure / sqrt(fabs(e.cosine2_beyond));
    TEST_ASSERT_DOUBLE_WITHIN(tolerance, e.x, in.x);
    TEST_ASSERT_DOUBLE_WITHIN(tolerance, e.y, in.y);
    TEST_ASSERT_DOUBLE_WITHIN(tolerance, e.z, in.z);
}

static const float etas[] = {0.25f, 0.66f, 0.999f,   1.0f, 1.0001f,
                             1.33f, 1.5f,  1.78846f, 2.4f, 4.0f};
enum { ETAS = sizeof etas / sizeof *etas };

static void snells_law_holds_all_around(void)
{
    for (uint64_t i = 0; i < 4000; i++)
        for (int k = 0; k < ETAS; k++)
            expect_snell(some_direction(2 * i), some_direction(2 * i + 1),
                         etas[k]);
}

/* From either side, from straight on to within 1e-6 of grazing. */
static void snells_law_holds_at_every_angle(void)
{
    struct surface s = flat_surface();
    for (int i = 0; i <= 2000; i++)
        for (int k = 0; k < ETAS; k++) {
            float angle = 3.14159265f * (float)i / 2000.0f;
            expect_snell(s.shading_normal, direction_at(&s, angle, 1.0f),
                         etas[k]);
        }
    for (float off = 0.1f; off > 1e-6f; off *= 0.5f)
        for (int k = 0; k < ETAS; k++) {
            float angle = 1.57079633f;
            expect_snell(s.shading_normal, direction_at(&s, angle - off, 2.0f),
                         etas[k]);
            expect_snell(s.shading_normal, direction_at(&s, angle + off, 2.0f),
                         etas[k]);
        }
}

static void a_known_angle(void)
{
    vec3 n = vec3_make(0.0f, 0.0f, 1.0f), in;
    /* 60 degrees in air, 35.2644 in glass of eta sqrt(9/4): sin = .866/1.5. */
    TEST_ASSERT_TRUE(
        refraction_direction(n, vec3_make(0.8660254f, 0.0f, 0.5f), 1.5f, &in));
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, -0.5773503f, in.x);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, -0.8164966f, in.z);
    /* The same way back out. */
    TEST_ASSERT_TRUE(refraction_direction(
        n, vec3_make(0.5773503f, 0.0f, -0.8164966f), 1.5f, &in));
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, -0.8660254f, in.x);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.5f, in.z);
}

static void straight_on_goes_straight_through(void)
{
    for (uint64_t i = 0; i < 200; i++)
        for (int k = 0; k < 2 * ETAS; k++) {
            vec3 n = some_direction(i), in;
            vec3 o = k % 2 ? n : vec3_negate(n);
            TEST_ASSERT_TRUE(refraction_direction(n, o, etas[k / 2], &in));
            TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.0f, vec3_length(vec3_add(in, o)));
        }
}

/* Nothing bends between equal indices, not even at the most glancing angle. */
static void equal_indices_bend_nothing(void)
{
    struct surface s = flat_surface();
    for (float off = 1.5f; off > 1e-6f; off *= 0.7f) {
        vec3 o = direction_at(&s, 1.57079633f - off, 0.5f), in;
        TEST_ASSERT_TRUE(refraction_direction(s.shading_normal, o, 1.0f, &in));
        TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.0f, vec3_length(vec3_add(in, o)));
    }
}

static void total_reflection_starts_at_the_critical_angle(void)
{
    struct surface s = flat_surface();
    vec3 n = s.shading_normal, in;
    for (int k = 5; k < ETAS; k++) {
        float inside = 3.14159265f - asinf(1.0f / etas[k]);
        vec3 steeper = direction_at(&s, inside + 1e-4f, 0.3f);
        vec3 flatter = direction_at(&s, inside - 1e-4f, 0.3f);
        TEST_ASSERT_TRUE(refraction_direction(n, steeper, etas[k], &in));
        TEST_ASSERT_TRUE(vec3_dot(in, n) > 0.0f);
        TEST_ASSERT_FALSE(refraction_direction(n, flatter, etas[k], &in));
        TEST_ASSERT_TRUE(vec3_dot(in, n) < 0.0f);
        /* From the outside light always gets in. */
        TEST_ASSERT_TRUE(refraction_direction(
            n, direction_at(&s, 1.5707f, 0.3f), etas[k], &in));
        TEST_ASSERT_FLOAT_WITHIN(2e-4f, -sqrtf(1 - 1 / (etas[k] * etas[k])),
                                 vec3_dot(in, n));
    }
}

/* Light can go either way along a path. Grazing directions are left out: they
 * move far when a last digit changes. */
static void the_way_back_is_the_same(void)
{
    for (uint64_t i = 0; i < 4000; i++)
        for (int k = 0; k < ETAS; k++) {
            vec3 n = some_direction(2 * i), o = some_direction(2 * i + 1);
            vec3 in, back;
            if (!refraction_direction(n, o, etas[k], &in) ||
                fabsf(vec3_dot(in, n)) < 0.05f || fabsf(vec3_dot(o, n)) < 0.05f)
                continue;
            TEST_ASSERT_TRUE(refraction_direction(n, in, etas[k], &back));
            TEST_ASSERT_FLOAT_WITHIN(5e-5f, 0.0f,
                                     vec3_length(vec3_sub(back, o)));
        }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(snells_law_holds_all_around);
    RUN_TEST(snells_law_holds_at_every_angle);
    RUN_TEST(a_known_angle);
    RUN_TEST(straight_on_goes_straight_through);
    RUN_TEST(equal_indices_bend_nothing);
    RUN_TEST(total_reflection_starts_at_the_critical_angle);
    RUN_TEST(the_way_back_is_the_same);
    return UNITY_END();
}
