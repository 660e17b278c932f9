/* test_sphere.c - tests of sphere.h: against the closed form in long double,
 * and the surface that a hit gives. */
#include "shapes/sphere.h"

#include "base/constants.h"
#include "sampling/sampler.h"

#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static struct sphere sphere_at(float x, float y, float z, float radius)
{
    struct sphere s = {vec3_make(x, y, z), radius};
    return s;
}

static ray ray_along_x(float x, float y)
{
    return ray_make(vec3_make(x, y, 0), vec3_make(1, 0, 0), 0, INFINITY);
}

static void expect_hit(struct sphere s, ray r, float want, const char *why)
{
    float t = -7.0f;
    TEST_ASSERT_TRUE_MESSAGE(sphere_intersect(&s, &r, &t), why);
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(1e-5f * fabsf(want), want, t, why);
}

static void expect_miss(struct sphere s, ray r, const char *why)
{
    float t = -7.0f;
    TEST_ASSERT_FALSE_MESSAGE(sphere_intersect(&s, &r, &t), why);
    TEST_ASSERT_EQUAL_FLOAT_MESSAGE(-7.0f, t, "a miss leaves *t alone");
}

static void the_nearer_side_is_hit(void)
{
    expect_hit(sphere_at(5, 0, 0, 2), ray_along_x(0, 0), 3, "from outside");
    expect_hit(sphere_at(5, 0, 0, 2), ray_along_x(4, 0), 3, "from inside");
    expect_hit(sphere_at(5, 0, 0, 2), ray_along_x(5, 0), 2, "from the centre");
    expect_miss(sphere_at(5, 0, 0, 2), ray_along_x(8, 0), "it lies behind");
    expect_miss(sphere_at(5, 0, 0, 2), ray_along_x(0, 2.001f), "passed by");
}

static void the_range_is_closed(void)
{
    struct sphere s = sphere_at(5, 0, 0, 2);
    ray r = ray_along_x(0, 0);
    r.t_max = 3.0f;
    expect_hit(s, r, 3, "t = t_max");
    r.t_max = 2.9375f;
    expect_miss(s, r, "both sides lie beyond t_max");
    r.t_max = INFINITY;
    r.t_min = 3.0f;
    expect_hit(s, r, 3, "t = t_min");
    r.t_min = 3.0625f;
    expect_hit(s, r, 7, "the far side when the near one is before t_min");
    r.t_min = 7.0625f;
    expect_miss(s, r, "both sides lie before t_min");
    r.t_min = 4.0f;
    r.t_max = 6.0f;
    expect_miss(s, r, "the range ends inside the sphere");
}

static void t_counts_in_lengths_of_the_direction(void)
{
    ray r = ray_make(vec3_make(0, 0, 0), vec3_make(4, 0, 0), 0, INFINITY);
    expect_hit(sphere_at(5, 0, 0, 2), r, 0.75f, "direction of length 4");
    r = ray_make(vec3_make(0, 0, 0), vec3_make(1e-3f, 0, 0), 0, INFINITY);
    expect_hit(sphere_at(5, 0, 0, 2), r, 3e3f, "direction of length 1e-3");
}

/* Whole numbers: no rounding, so that the tangent is met exactly. */
static void a_tangent_counts(void)
{
    expect_hit(sphere_at(5, 0, 0, 2), ray_along_x(0, 2), 5, "grazes the top");
    expect_hit(sphere_at(0, 0, 0, 2), ray_along_x(-3, -2), 3, "grazes below");
}

/* The closed form ----------------------------------------------------------
 *
 * What float can give at best is the right t for a sphere and ray whose
 * numbers are wrong in their last digits: lengths of the size of everything
 * that takes part, `extent`, by a few 2^-24. Moving the sphere by that much
 * moves t by it / cos at the hit, which is where the tolerance comes from.
 * Rays that are closer than that to a tangent may be judged either way. */

struct exact {
    long double t0, t1; /* t0 <= t1 */
    long double inside; /* radius^2 - (distance of line and centre)^2 */
    long double extent;
};

static struct exact solve(const struct sphere *s, const ray *r)
{
    long double o[3] = {r->origin.x, r->origin.y, r->origin.z};
    long double d[3] = {r->direction.x, r->direction.y, r->direction.z};
    long double c[3] = {s->center.x, s->center.y, s->center.z};
    long double a = 0, b = 0, distance2 = 0, radius = s->radius;
    struct exact e;
    for (int i = 0; i < 3; i++) {
        a += d[i] * d[i];
        b += d[i] * (c[i] - o[i]);
    }
    for (int i = 0; i < 3; i++) {
        long double miss = c[i] - o[i] - d[i] * (b / a);
        distance2 += miss * miss;
    }
    e.inside = radius * radius - distance2;
    long double half = e.inside > 0 ? sqrtl(e.inside / a) : 0;
    e.t0 = b / a - half;
    e.t1 = b / a + half;
    e.extent = radius + vec3_length(vec3_abs(r->origin)) +
               vec3_length(vec3_abs(s->center));
    return e;
}

/* How many last digits of the largest length may be wrong. */
static const long double digits = 8.0L * 0x1p-24L;

static void expect_like_exact(const struct sphere *s, const ray *r)
{
    struct exact e = solve(s, r);
    long double radius = s->radius, length = vec3_length(r->direction);
    long double slack = digits * e.extent;
    float t = -7.0f;
    bool hit = sphere_intersect(s, r, &t);
    if (fabsl(e.inside) <= 4 * slack * (radius + slack))
        return; /* as good as tangent */
    long double cosine = sqrtl(fabsl(e.inside)) / radius;
    long double tolerance = slack / cosine / length;
    bool near = e.inside > 0 && e.t0 >= r->t_min + tolerance;
    bool far = e.inside > 0 && e.t1 >= r->t_min + tolerance;
    if (e.inside > 0 && (fabsl(e.t0 - r->t_min) < tolerance ||
                         fabsl(e.t1 - r->t_min) < tolerance))
        return; /* starts on the sphere */
    TEST_ASSERT_EQUAL_INT_MESSAGE(near || far, hit, "hit or miss");
    if (!hit)
        return;
    TEST_ASSERT_TRUE_MESSAGE(fabsl(t - (near ? e.t0 : e.t1)) <= tolerance,
                             "t against the closed form");
}

static vec3 random_vector(struct sampler *random, float size)
{
    float x = sampler_1d(random), y = sampler_1d(random);
    return vec3_make(size * (2 * x - 1), size * (2 * y - 1),
                     size * (2 * sampler_1d(random) - 1));
}

/* Rays from `distance` away towards points in and a little around the sphere;
 * the sphere's centre lies up to `offset` from the coordinates' origin. */
static void try_spheres(float radius, float distance, float offset)
{
    for (uint64_t i = 0; i < 4000; i++) {
        struct sampler random = sampler_start(SAMPLER_INDEPENDENT, 1,
                                              (uint64_t)lroundf(radius), i, 1);
        struct sphere s = {random_vector(&random, offset), radius};
        vec3 origin = vec3_add(s.center, random_vector(&random, distance));
        vec3 aim = vec3_add(s.center, random_vector(&random, 1.2f * radius));
        vec3 d = vec3_sub(aim, origin);
        if (!(vec3_length(d) > 0))
            continue;
        float scale = powf(10.0f, 4.0f * sampler_1d(&random) - 2.0f);
        ray r = ray_make(origin, vec3_scale(d, scale), 0, INFINITY);
        expect_like_exact(&s, &r);
    }
}

static void spheres_of_all_sizes_match_the_closed_form(void)
{
    for (int k = -4; k <= 6; k++) {
        float radius = powf(10.0f, (float)k);
        try_spheres(radius, 3 * radius, 0);
        try_spheres(radius, 3 * radius, 5 * radius);
    }
}

static void tiny_spheres_far_away_match_the_closed_form(void)
{
    try_spheres(1e-3f, 1.0f, 1.0f);
    try_spheres(1e-2f, 1e3f, 10.0f);
    try_spheres(1.0f, 1e5f, 1.0f);
}

static void rays_that_start_inside_match_the_closed_form(void)
{
    try_spheres(1.0f, 0.5f, 0.0f);
    try_spheres(1e4f, 5e3f, 1e4f);
    try_spheres(1e-4f, 5e-5f, 1e-3f);
}

/* The ground as a sphere of 1000 km, and an eye two metres above it. */
static void a_huge_sphere_below_matches_the_closed_form(void)
{
    struct sphere ground = sphere_at(0, -1e6f, 0, 1e6f);
    for (uint64_t i = 0; i < 4000; i++) {
        struct sampler random = sampler_start(SAMPLER_INDEPENDENT, 2, 0, i, 1);
        vec3 d = random_vector(&random, 1);
        ray r = ray_make(vec3_make(0, 2, 0), d, 0, INFINITY);
        expect_like_exact(&ground, &r);
    }
}

static void expect_digits(const struct sphere *s, const ray *r,
                          long double want)
{
    float t = -7.0f;
    TEST_ASSERT_TRUE(sphere_intersect(s, r, &t));
    TEST_ASSERT_TRUE_MESSAGE(fabsl(t - want) <= 1e-6L * want,
                             "no digits are lost by cancellation");
}

/* Everything is a whole number but the direction: only a root that is computed
 * as the difference of two large numbers loses digits here. */
static void the_wall_of_a_large_sphere_close_by_keeps_its_digits(void)
{
    struct sphere s = sphere_at(0, 0, 0, 1024);
    for (int i = -9; i <= 9; i++) {
        vec3 d = vec3_make(0.1f * (float)i, 1, 0);
        ray out = ray_make(vec3_make(0, 1023, 0), d, 0, INFINITY);
        ray in = ray_make(vec3_make(0, -1025, 0), d, 0, INFINITY);
        expect_digits(&s, &out, solve(&s, &out).t1);
        expect_digits(&s, &in, solve(&s, &in).t0);
    }
}

/* The surface ------------------------------------------------------------- */

static struct surface hit_surface(struct sphere s, ray r)
{
    float t = 0.0f;
    TEST_ASSERT_TRUE(sphere_intersect(&s, &r, &t));
    struct surface met;
    sphere_surface(&s, &r, t, &met);
    return met;
}

static long double distance_off(const struct sphere *s, vec3 p)
{
    long double x = (long double)p.x - s->center.x;
    long double y = (long double)p.y - s->center.y;
    long double z = (long double)p.z - s->center.z;
    return fabsl(sqrtl(x * x + y * y + z * z) - s->radius);
}

/* The position is on the sphere within the error that it states. */
static void positions_are_on_the_sphere(void)
{
    for (int k = -3; k <= 4; k++)
        for (uint64_t i = 0; i < 2000; i++) {
            struct sampler random =
                sampler_start(SAMPLER_INDEPENDENT, 3, (uint64_t)(k + 3), i, 1);
            float size = powf(10.0f, (float)k);
            struct sphere s = {random_vector(&random, 4 * size), size};
            vec3 out = random_vector(&random, 1);
            vec3 eye = vec3_step(s.center, 100 * size, out);
            ray r = ray_make(eye, vec3_negate(out), 0, INFINITY);
            struct surface p = hit_surface(s, r);
            vec3 n = vec3_abs(p.geometric_normal);
            TEST_ASSERT_TRUE(distance_off(&s, p.position) <=
                             vec3_dot(n, p.position_error));
            TEST_ASSERT_FLOAT_WITHIN(1e-6f, 1, vec3_length(p.geometric_normal));
        }
}

static void normals_point_outwards_from_inside_too(void)
{
    struct sphere s = sphere_at(5, 0, 0, 2);
    struct surface outside = hit_surface(s, ray_along_x(0, 0));
    struct surface inside = hit_surface(s, ray_along_x(5, 0));
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, -1, outside.geometric_normal.x);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 1, inside.geometric_normal.x);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 1, inside.shading_normal.x);
}

static void expect_uv(vec3 from, float u, float v)
{
    struct sphere s = sphere_at(0, 0, 0, 2);
    ray r = ray_make(vec3_scale(from, 10), vec3_negate(from), 0, INFINITY);
    vec2 uv = hit_surface(s, r).uv;
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(1e-5f, u, uv.x, "u = phi / 2 pi");
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(1e-5f, v, uv.y, "v = theta / pi");
}

static void texture_coordinates_follow_the_convention(void)
{
    expect_uv(vec3_make(1, 0, 0), 0.0f, 0.5f);
    expect_uv(vec3_make(0, 1, 0), 0.25f, 0.5f);
    expect_uv(vec3_make(-1, 0, 0), 0.5f, 0.5f);
    expect_uv(vec3_make(0, -1, 0), 0.75f, 0.5f);
    expect_uv(vec3_make(1, 1, 1.41421356f), 0.125f, 0.25f);
    expect_uv(vec3_make(1, 1, -1.41421356f), 0.125f, 0.75f);
}

static void the_poles_have_finite_coordinates(void)
{
    for (int sign = -1; sign <= 1; sign += 2) {
        vec3 up = vec3_make(0, 0, (float)sign);
        ray r = ray_make(vec3_scale(up, 9), vec3_negate(up), 0, INFINITY);
        struct surface s = hit_surface(sphere_at(0, 0, 0, 2), r);
        TEST_ASSERT_FLOAT_WITHIN(1e-6f, sign > 0 ? 0 : 1, s.uv.y);
        TEST_ASSERT_TRUE(isfinite(s.uv.x));
        TEST_ASSERT_TRUE(vec3_is_finite(s.dp_du) && vec3_is_finite(s.dp_dv));
        TEST_ASSERT_EQUAL_FLOAT_MESSAGE(0, vec3_length(s.dp_du), "no phi");
    }
}

/* The point with texture coordinates (u, v). */
static vec3 point_at(const struct sphere *s, double u, double v)
{
    const double pi = 3.14159265358979323846;
    double phi = 2 * pi * u, theta = pi * v, r = s->radius;
    return vec3_make((float)(s->center.x + r * sin(theta) * cos(phi)),
                     (float)(s->center.y + r * sin(theta) * sin(phi)),
                     (float)(s->center.z + r * cos(theta)));
}

static void expect_difference(vec3 derivative, vec3 a, vec3 b, float step)
{
    vec3 difference = vec3_scale(vec3_sub(b, a), 1.0f / step);
    float tolerance = 2e-2f * (1.0f + vec3_length(derivative));
    TEST_ASSERT_FLOAT_WITHIN(tolerance, difference.x, derivative.x);
    TEST_ASSERT_FLOAT_WITHIN(tolerance, difference.y, derivative.y);
    TEST_ASSERT_FLOAT_WITHIN(tolerance, difference.z, derivative.z);
}

static void differentials_match_finite_differences(void)
{
    struct sphere s = sphere_at(1, -2, 3, 2);
    const float h = 1e-3f;
    for (float u = 0.02f; u < 1.0f; u += 0.07f)
        for (float v = 0.05f; v < 1.0f; v += 0.1f) {
            vec3 p = point_at(&s, u, v);
            vec3 out = vec3_sub(p, s.center);
            ray r = ray_make(vec3_add(p, out), vec3_negate(out), 0, INFINITY);
            struct surface hit = hit_surface(s, r);
            expect_difference(hit.dp_du, point_at(&s, u - h, v),
                              point_at(&s, u + h, v), 2 * h);
            expect_difference(hit.dp_dv, point_at(&s, u, v - h),
                              point_at(&s, u, v + h), 2 * h);
        }
}

static void bounds_touch_the_sphere(void)
{
    struct sphere s = sphere_at(1, 2, 3, 0.5f);
    aabb box = sphere_bounds(&s);
    TEST_ASSERT_EQUAL_FLOAT(0.5f, box.lower.x);
    TEST_ASSERT_EQUAL_FLOAT(2.5f, box.upper.y);
    TEST_ASSERT_EQUAL_FLOAT(3.5f, box.upper.z);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(the_nearer_side_is_hit);
    RUN_TEST(the_range_is_closed);
    RUN_TEST(t_counts_in_lengths_of_the_direction);
    RUN_TEST(a_tangent_counts);
    RUN_TEST(spheres_of_all_sizes_match_the_closed_form);
    RUN_TEST(tiny_spheres_far_away_match_the_closed_form);
    RUN_TEST(rays_that_start_inside_match_the_closed_form);
    RUN_TEST(a_huge_sphere_below_matches_the_closed_form);
    RUN_TEST(the_wall_of_a_large_sphere_close_by_keeps_its_digits);
    RUN_TEST(positions_are_on_the_sphere);
    RUN_TEST(normals_point_outwards_from_inside_too);
    RUN_TEST(texture_coordinates_follow_the_convention);
    RUN_TEST(the_poles_have_finite_coordinates);
    RUN_TEST(differentials_match_finite_differences);
    RUN_TEST(bounds_touch_the_sphere);
    return UNITY_END();
}
