/* test_surface.c - tests of surface.h: a ray that leaves a surface does not
 * hit it again, whatever the scale, and does not skip what is close by.
 *
 * Two faults are looked for: shadow acne (the ray hits its own surface) and
 * leaks (the ray starts so far off that it passes through a neighbour). */
#include "shapes/surface.h"

#include "sampling/sampler.h"
#include "shapes/mesh.h"
#include "shapes/sphere.h"

#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static vec3 random_vector(struct sampler *random, float size)
{
    float x = sampler_1d(random), y = sampler_1d(random);
    return vec3_make(size * (2 * x - 1), size * (2 * y - 1),
                     size * (2 * sampler_1d(random) - 1));
}

/* A direction of length one; some of them graze the plane of normal n. */
static vec3 random_direction(struct sampler *random, vec3 n)
{
    vec3 d = random_vector(random, 1);
    if (sampler_1d(random) < 0.3f) /* flattened towards the plane */
        d = vec3_step(d, -0.999f * vec3_dot(d, n), n);
    return vec3_normalize(d);
}

/* A triangle of about the given size, not a sliver: the sine of its angle at
 * p0 is above 0.1. */
static void random_triangle(struct sampler *random, float size, float offset,
                            vec3 p[3])
{
    vec3 n, e1, e2;
    p[0] = random_vector(random, offset);
    do {
        e1 = random_vector(random, size);
        e2 = random_vector(random, size);
        n = vec3_cross(e1, e2);
    } while (vec3_length(n) < 0.1f * vec3_length(e1) * vec3_length(e2));
    p[1] = vec3_add(p[0], e1);
    p[2] = vec3_add(p[0], e2);
}

/* The surface where a ray from `eye` away meets a random point of p. */
static bool random_hit(struct sampler *random, vec3 p[3], float eye,
                       struct surface *out)
{
    uint32_t indices[3] = {0, 1, 2};
    struct mesh m = {p, NULL, NULL, indices, 3, 1};
    struct triangle_hit hit;
    float b1 = sampler_1d(random), b2 = sampler_1d(random) * (1 - b1);
    vec3 aim = vec3_step(vec3_step(p[0], b1, vec3_sub(p[1], p[0])), b2,
                         vec3_sub(p[2], p[0]));
    vec3 origin = vec3_add(aim, random_vector(random, eye));
    ray r = ray_make(origin, vec3_sub(aim, origin), 0, INFINITY);
    if (!triangle_intersect(p, &r, &hit))
        return false; /* aimed at the rim */
    mesh_surface(&m, 0, &hit, out);
    return true;
}

static void leave_triangle(struct sampler *random, vec3 p[3], float eye)
{
    struct surface s;
    struct triangle_hit again;
    if (!random_hit(random, p, eye, &s))
        return;
    for (int i = 0; i < 4; i++) {
        vec3 d = random_direction(random, s.geometric_normal);
        ray r = surface_ray(&s, d, INFINITY);
        TEST_ASSERT_FALSE_MESSAGE(triangle_intersect(p, &r, &again),
                                  "surface_ray hits its own triangle");
        ray way = surface_segment(&s, vec3_step(s.position, 10 * eye, d));
        TEST_ASSERT_FALSE_MESSAGE(triangle_intersect(p, &way, &again),
                                  "surface_segment hits its own triangle");
    }
}

static void leave_triangles(float size, float offset)
{
    for (uint64_t i = 0; i < 10000; i++) {
        struct sampler random = sampler_start(SAMPLER_INDEPENDENT, 1,
                                              (uint64_t)(1e3f * size), i, 1);
        vec3 p[3];
        random_triangle(&random, size, offset, p);
        leave_triangle(&random, p, 3 * (size + offset));
    }
}

static void no_ray_hits_the_triangle_that_it_leaves(void)
{
    for (int k = -3; k <= 4; k++)
        leave_triangles(powf(10.0f, (float)k), 0);
}

static void no_ray_hits_a_triangle_far_from_the_origin(void)
{
    for (int k = -3; k <= 4; k++)
        leave_triangles(powf(10.0f, (float)k), 30 * powf(10.0f, (float)k));
}

static void no_ray_hits_a_triangle_in_an_axis_plane(void)
{
    for (uint64_t i = 0; i < 30000; i++) {
        struct sampler random = sampler_start(SAMPLER_INDEPENDENT, 2, 0, i, 1);
        vec3 p[3];
        float size = powf(10.0f, 7.0f * sampler_1d(&random) - 3.0f);
        random_triangle(&random, size, 0, p);
        float level = size * (float)(int)(4.0f * sampler_1d(&random));
        p[0].y = p[1].y = p[2].y = level;
        leave_triangle(&random, p, 3 * size);
    }
}

static struct surface random_sphere_hit(struct sampler *random,
                                        const struct sphere *s)
{
    float t = 0.0f;
    vec3 d = vec3_normalize(random_vector(random, 1));
    ray r = ray_make(vec3_step(s->center, 5 * s->radius, d), vec3_negate(d), 0,
                     INFINITY);
    TEST_ASSERT_TRUE(sphere_intersect(s, &r, &t));
    struct surface met;
    sphere_surface(s, &r, t, &met);
    return met;
}

/* Outwards it meets nothing; inwards it meets the far wall, which is at twice
 * the radius times the cosine, and not the wall that it starts from. */
static void leave_sphere(struct sampler *random, const struct sphere *s)
{
    struct surface p = random_sphere_hit(random, s);
    for (int i = 0; i < 4; i++) {
        float t = -1.0f;
        vec3 d = random_direction(random, p.geometric_normal);
        float cosine = vec3_dot(d, p.geometric_normal);
        ray r = surface_ray(&p, d, INFINITY);
        bool hit = sphere_intersect(s, &r, &t);
        if (cosine >= 0.0f) {
            TEST_ASSERT_FALSE_MESSAGE(hit, "hits the sphere that it leaves");
        } else if (hit) {
            TEST_ASSERT_TRUE_MESSAGE(t >= -s->radius * cosine,
                                     "inwards, hits the wall it starts from");
        } else { /* it may slip through the rim when it grazes */
            TEST_ASSERT_TRUE_MESSAGE(cosine > -1e-2f, "misses the far wall");
        }
    }
}

static void leave_spheres(float radius, float offset)
{
    for (uint64_t i = 0; i < 10000; i++) {
        struct sampler random = sampler_start(SAMPLER_INDEPENDENT, 3,
                                              (uint64_t)(1e3f * radius), i, 1);
        struct sphere s = {random_vector(&random, offset), radius};
        leave_sphere(&random, &s);
    }
}

static void no_ray_hits_the_sphere_that_it_leaves(void)
{
    for (int k = -3; k <= 4; k++)
        leave_spheres(powf(10.0f, (float)k), 0);
}

static void no_ray_hits_a_sphere_far_from_the_origin(void)
{
    for (int k = -3; k <= 4; k++)
        leave_spheres(powf(10.0f, (float)k), 30 * powf(10.0f, (float)k));
}

static struct surface floor_point(float x, float level, float z)
{
    vec3 at = vec3_make(x, level, z);
    struct surface s = {.position = at,
                        .position_error = vec3_scale(vec3_abs(at), 4e-7f),
                        .geometric_normal = {0, 1, 0},
                        .shading_normal = {0, 1, 0},
                        .dp_du = {1, 0, 0},
                        .dp_dv = {0, 0, 1}};
    return s;
}

static void the_start_moves_to_the_side_of_the_direction(void)
{
    struct surface s = floor_point(1, 2, 3);
    ray up = surface_ray(&s, vec3_make(0.6f, 0.8f, 0), 7);
    ray down = surface_ray(&s, vec3_make(0.6f, -0.8f, 0), 7);
    TEST_ASSERT_TRUE(up.origin.y > 2.0f && down.origin.y < 2.0f);
    TEST_ASSERT_TRUE(up.t_min > 0.0f);
    TEST_ASSERT_EQUAL_FLOAT(7, up.t_max);
    TEST_ASSERT_EQUAL_FLOAT(0.8f, up.direction.y);
}

/* No further than a few last digits of the coordinates: no leak. */
static void the_start_stays_close(void)
{
    for (float size = 1e-3f; size < 2e4f; size *= 10) {
        struct surface s = floor_point(size, 2 * size, -size);
        ray r = surface_ray(&s, vec3_make(0, 1, 0), INFINITY);
        float moved = vec3_length(vec3_sub(r.origin, s.position));
        TEST_ASSERT_TRUE_MESSAGE(moved <= 4e-6f * size, "starts too far off");
    }
}

/* Even where the offset is too small to change the coordinate. */
static void the_start_moves_when_the_offset_rounds_away(void)
{
    struct surface s = floor_point(0, 1e4f, 0);
    s.position_error = vec3_make(1e-9f, 1e-9f, 1e-9f);
    ray up = surface_ray(&s, vec3_make(0, 1, 0), INFINITY);
    ray down = surface_ray(&s, vec3_make(0, -1, 0), INFINITY);
    TEST_ASSERT_TRUE(up.origin.y > 1e4f && down.origin.y < 1e4f);
}

static void a_segment_ends_before_its_point(void)
{
    struct surface s = floor_point(0, 0, 0);
    vec3 light = vec3_make(0, 8, 6);
    ray r = surface_segment(&s, light);
    vec3 end = ray_at(&r, 1.0f);
    TEST_ASSERT_TRUE(r.t_min > 0.0f && r.t_max < 1.0f && r.t_max > 0.99999f);
    TEST_ASSERT_FLOAT_WITHIN(1e-5f, light.y, end.y);
    TEST_ASSERT_FLOAT_WITHIN(1e-5f, light.z, end.z);
}

/* What lies just before the point is met, the point's own plane is not. */
static void a_segment_sees_what_is_before_its_point(void)
{
    struct surface s = floor_point(0, 0, 0);
    ray r = surface_segment(&s, vec3_make(0, 8, 0));
    struct triangle_hit hit;
    for (int i = 0; i < 2; i++) {
        float y = i == 0 ? 7.9999f : 8.0f;
        const vec3 p[3] = {{-1, y, -1}, {-1, y, 2}, {2, y, -1}};
        TEST_ASSERT_EQUAL_INT(i == 0, triangle_intersect(p, &r, &hit));
    }
}

/* An offset too small to change a large coordinate still moves the ray off. */
static void rays_start_at_the_next_number_outwards(void)
{
    const float places[] = {1.0f,   -1.0f,      0.0f,      1e-40f,
                            -1e30f, 3.4028e38f, 0x1p-126f, -0x1p-126f};
    const float offset = 1e-44f;
    for (int i = 0; i < 8; i++) {
        float x = places[i];
        vec3 normal = vec3_make(1.0f, 0.0f, 0.0f);
        struct surface s = {.position = vec3_make(x, 0.0f, 0.0f),
                            .position_error = vec3_make(offset, 0.0f, 0.0f),
                            .geometric_normal = normal};
        ray out = surface_ray(&s, normal, INFINITY);
        ray in = surface_ray(&s, vec3_negate(normal), INFINITY);
        TEST_ASSERT_TRUE(out.origin.x == nextafterf(x + offset, INFINITY));
        TEST_ASSERT_TRUE(in.origin.x == nextafterf(x - offset, -INFINITY));
        TEST_ASSERT_TRUE(out.origin.y == 0.0f && in.origin.z == 0.0f);
    }
}

static void rays_without_extent_have_no_footprint(void)
{
    struct ray_differential d = {.direction_dx = {0.01f, 0.0f, 0.0f}};
    const struct ray_differential none = {.direction_dx = {0.0f, 0.0f, 0.0f}};
    const struct sphere ball = {{0.0f, 0.0f, 0.0f}, 1.0f};
    ray r = ray_make(vec3_make(0.1f, -3.0f, 0.2f), vec3_make(0.0f, 1.0f, 0.0f),
                     0.0f, INFINITY);
    float t;
    TEST_ASSERT_TRUE(sphere_intersect(&ball, &r, &t));
    struct surface s;
    sphere_surface(&ball, &r, t, &s);
    surface_footprint(&s, &r, &d);
    TEST_ASSERT_TRUE(s.uv_dx.x > 0.001f);
    TEST_ASSERT_TRUE(s.uv_dy.x == 0.0f && s.uv_dy.y == 0.0f);
    surface_footprint(&s, &r, &none);
    TEST_ASSERT_TRUE(s.uv_dx.x == 0.0f && s.uv_dx.y == 0.0f);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(no_ray_hits_the_triangle_that_it_leaves);
    RUN_TEST(no_ray_hits_a_triangle_far_from_the_origin);
    RUN_TEST(no_ray_hits_a_triangle_in_an_axis_plane);
    RUN_TEST(no_ray_hits_the_sphere_that_it_leaves);
    RUN_TEST(no_ray_hits_a_sphere_far_from_the_origin);
    RUN_TEST(the_start_moves_to_the_side_of_the_direction);
    RUN_TEST(the_start_stays_close);
    RUN_TEST(the_start_moves_when_the_offset_rounds_away);
    RUN_TEST(a_segment_ends_before_its_point);
    RUN_TEST(a_segment_sees_what_is_before_its_point);
    RUN_TEST(rays_start_at_the_next_number_outwards);
    RUN_TEST(rays_without_extent_have_no_footprint);
    return UNITY_END();
}
