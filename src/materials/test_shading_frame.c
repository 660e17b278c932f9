/* test_shading_frame.c - orthonormal wherever u points. */
#include "materials/shading_frame.h"

#include "materials/test_materials.h"
#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static struct shading_frame expect_orthonormal(const struct surface *s)
{
    struct shading_frame f = shading_frame_make(s);
    TEST_ASSERT_EQUAL_FLOAT(s->shading_normal.x, f.z.x);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 1.0f, vec3_length(f.x));
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 1.0f, vec3_length(f.y));
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.0f, vec3_dot(f.x, f.z));
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.0f, vec3_dot(f.y, f.z));
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.0f, vec3_dot(f.x, f.y));
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 1.0f, vec3_dot(vec3_cross(f.x, f.y), f.z));
    return f;
}

static void x_runs_along_u(void)
{
    for (uint64_t i = 0; i < 1000; i++) {
        vec3 n = some_direction(2 * i);
        struct surface s = surface_with(n, n);
        s.dp_du = vec3_scale(some_direction(2 * i + 1), 1e-3f * (float)(i + 1));
        struct shading_frame f = expect_orthonormal(&s);
        TEST_ASSERT_TRUE(vec3_dot(f.x, s.dp_du) > 0.0f);
        vec3 across = vec3_cross(f.z, s.dp_du);
        TEST_ASSERT_FLOAT_WITHIN(1e-5f * vec3_length(s.dp_du), 0.0f,
                                 vec3_dot(f.x, across));
    }
}

/* Down to where only rounding errors are left of u, and nothing at all. */
static void u_along_the_normal_is_no_harm(void)
{
    for (uint64_t i = 0; i < 1000; i++) {
        vec3 n = some_direction(2 * i), side = some_direction(2 * i + 1);
        struct surface s = surface_with(n, n);
        for (float k = 1e-2f; k > 1e-12f; k *= 0.1f) {
            s.dp_du = vec3_step(n, k, side);
            expect_orthonormal(&s);
        }
        s.dp_du = n;
        expect_orthonormal(&s);
        s.dp_du = vec3_scale(side, 1e-30f);
        expect_orthonormal(&s);
        s.dp_du = vec3_make(0.0f, 0.0f, 0.0f);
        expect_orthonormal(&s);
    }
}

static void there_and_back_is_the_same(void)
{
    struct surface s = smooth_surface();
    struct shading_frame f = shading_frame_make(&s);
    for (uint64_t i = 0; i < 100; i++) {
        vec3 d = some_direction(i), local = shading_frame_to_local(&f, d);
        vec3 back = shading_frame_to_world(&f, local);
        TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.0f, vec3_length(vec3_sub(d, back)));
        TEST_ASSERT_FLOAT_WITHIN(1e-6f, vec3_dot(d, s.shading_normal), local.z);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(x_runs_along_u);
    RUN_TEST(u_along_the_normal_is_no_harm);
    RUN_TEST(there_and_back_is_the_same);
    return UNITY_END();
}
