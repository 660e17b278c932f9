/* test_triangle.c - the public tests of assignment 01.
 *
 * Most use one right triangle in the plane z = 0, drawn here from above:
 *
 *     p2 (0,2)
 *      |\
 *      | \        The numbers are whole or halves, so that floating
 *      |  \       point makes no error and an edge is met exactly.
 *      |___\
 *     p0    p1 (2,0)
 *
 * Read a test's name and its message; the contract is in shapes/triangle.h. */
#include "shapes/triangle.h"

#include "unity.h"

static const vec3 RIGHT_TRIANGLE[3] = {
    {0.0f, 0.0f, 0.0f}, {2.0f, 0.0f, 0.0f}, {0.0f, 2.0f, 0.0f}};

void setUp(void)
{
}

void tearDown(void)
{
}

/* A ray from five above (x, y), straight down: it meets z = 0 at t = 5. */
static ray down_at(float x, float y)
{
    return ray_make(vec3_make(x, y, 5.0f), vec3_make(0.0f, 0.0f, -1.0f), 0.0f,
                    INFINITY);
}

static void expect_hit(const vec3 p[3], ray r, struct triangle_hit want,
                       const char *why)
{
    struct triangle_hit hit = {-7.0f, -7.0f, -7.0f};
    TEST_ASSERT_TRUE_MESSAGE(triangle_intersect(p, &r, &hit), why);
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(1e-4f * fabsf(want.t), want.t, hit.t,
                                     "t: the hit is at origin + t direction");
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(1e-4f, want.b1, hit.b1,
                                     "b1: the weight of corner p1");
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(1e-4f, want.b2, hit.b2,
                                     "b2: the weight of corner p2");
}

static void expect_miss(const vec3 p[3], ray r, const char *why)
{
    struct triangle_hit hit = {-7.0f, -7.0f, -7.0f};
    TEST_ASSERT_FALSE_MESSAGE(triangle_intersect(p, &r, &hit), why);
}

static struct triangle_hit hit_at(float t, float b1, float b2)
{
    struct triangle_hit hit = {t, b1, b2};
    return hit;
}

static void a_ray_through_the_middle_hits(void)
{
    expect_hit(RIGHT_TRIANGLE, down_at(0.5f, 0.5f), hit_at(5.0f, 0.25f, 0.25f),
               "a ray through the inside must hit");
}

static void weights_belong_to_their_corners(void)
{
    expect_hit(RIGHT_TRIANGLE, down_at(1.5f, 0.25f),
               hit_at(5.0f, 0.75f, 0.125f), "a point near p1 must hit");
    expect_hit(RIGHT_TRIANGLE, down_at(0.25f, 1.5f),
               hit_at(5.0f, 0.125f, 0.75f), "a point near p2 must hit");
}

static void the_back_is_hit_like_the_front(void)
{
    ray up = ray_make(vec3_make(0.5f, 0.5f, -3.0f), vec3_make(0, 0, 1), 0.0f,
                      INFINITY);
    expect_hit(RIGHT_TRIANGLE, up, hit_at(3.0f, 0.25f, 0.25f),
               "both sides count: the winding must not matter");
}

static void edges_belong_to_the_triangle(void)
{
    expect_hit(RIGHT_TRIANGLE, down_at(1.0f, 0.0f), hit_at(5.0f, 0.5f, 0.0f),
               "the edge from p0 to p1 (b2 = 0) is part of the triangle");
    expect_hit(RIGHT_TRIANGLE, down_at(0.0f, 1.0f), hit_at(5.0f, 0.0f, 0.5f),
               "the edge from p0 to p2 (b1 = 0) is part of the triangle");
    expect_hit(RIGHT_TRIANGLE, down_at(1.0f, 1.0f), hit_at(5.0f, 0.5f, 0.5f),
               "the edge from p1 to p2 (b1 + b2 = 1) is part of the triangle");
}

static void corners_belong_to_the_triangle(void)
{
    expect_hit(RIGHT_TRIANGLE, down_at(0.0f, 0.0f), hit_at(5.0f, 0.0f, 0.0f),
               "corner p0 is part of the triangle");
    expect_hit(RIGHT_TRIANGLE, down_at(2.0f, 0.0f), hit_at(5.0f, 1.0f, 0.0f),
               "corner p1 is part of the triangle");
    expect_hit(RIGHT_TRIANGLE, down_at(0.0f, 2.0f), hit_at(5.0f, 0.0f, 1.0f),
               "corner p2 is part of the triangle");
}

static void just_outside_an_edge_is_a_miss(void)
{
    float step = 1.0f / 64.0f;
    expect_miss(RIGHT_TRIANGLE, down_at(1.0f, -step),
                "just outside the edge from p0 to p1: b2 < 0");
    expect_miss(RIGHT_TRIANGLE, down_at(-step, 1.0f),
                "just outside the edge from p0 to p2: b1 < 0");
    expect_miss(RIGHT_TRIANGLE, down_at(1.0f + step, 1.0f),
                "just outside the edge from p1 to p2: b1 + b2 > 1");
}

static void the_other_half_of_the_square_is_a_miss(void)
{
    expect_miss(RIGHT_TRIANGLE, down_at(1.5f, 1.5f),
                "b1 and b2 are both 0.75: each is below 1, their sum is not");
}

static void a_triangle_behind_the_ray_is_a_miss(void)
{
    ray away = ray_make(vec3_make(0.5f, 0.5f, 5.0f), vec3_make(0, 0, 1), 0.0f,
                        INFINITY);
    expect_miss(RIGHT_TRIANGLE, away, "t is -5, and t_min is 0");
}

static void t_min_itself_counts(void)
{
    ray r = down_at(0.5f, 0.5f);
    r.t_min = 5.0f;
    expect_hit(RIGHT_TRIANGLE, r, hit_at(5.0f, 0.25f, 0.25f),
               "the range is closed: t = t_min is a hit");
    r.t_min = 5.0625f;
    expect_miss(RIGHT_TRIANGLE, r, "t = 5 comes before t_min = 5.0625");
}

static void t_max_itself_counts(void)
{
    ray r = down_at(0.5f, 0.5f);
    r.t_max = 5.0f;
    expect_hit(RIGHT_TRIANGLE, r, hit_at(5.0f, 0.25f, 0.25f),
               "the range is closed: t = t_max is a hit");
    r.t_max = 4.9375f;
    expect_miss(RIGHT_TRIANGLE, r, "t = 5 comes after t_max = 4.9375");
}

static void t_counts_in_lengths_of_the_direction(void)
{
    ray r = down_at(0.5f, 0.5f);
    r = ray_make(r.origin, vec3_make(0, 0, -4), 0.0f, 2.0f);
    expect_hit(RIGHT_TRIANGLE, r, hit_at(1.25f, 0.25f, 0.25f),
               "a direction of length 4 covers the distance 5 at t = 1.25");
    r = ray_make(r.origin, vec3_make(0, 0, -0.25f), 0.0f, 10.0f);
    expect_miss(RIGHT_TRIANGLE, r,
                "a direction of length 1/4 needs t = 20, and t_max is 10");
}

static void a_slanted_ray_hits(void)
{
    ray r = ray_make(vec3_make(4.5f, 2.5f, 4.0f), vec3_make(-1, -0.5f, -1),
                     0.0f, INFINITY);
    expect_hit(RIGHT_TRIANGLE, r, hit_at(4.0f, 0.25f, 0.25f),
               "the ray comes from the side and meets (0.5, 0.5, 0)");
}

static void rays_along_every_axis_hit(void)
{
    const vec3 p[3] = {{4, 0, 0}, {0, 4, 0}, {0, 0, 4}};
    ray r = ray_make(vec3_make(-1, 1, 1), vec3_make(1, 0, 0), 0.0f, INFINITY);
    expect_hit(p, r, hit_at(3.0f, 0.25f, 0.25f), "direction (1, 0, 0)");
    r = ray_make(vec3_make(1, 9, 1), vec3_make(0, -1, 0), 0.0f, INFINITY);
    expect_hit(p, r, hit_at(7.0f, 0.5f, 0.25f), "direction (0, -1, 0)");
    r = ray_make(vec3_make(1, 1, 4), vec3_make(-0.0f, 0, -1), 0.0f, INFINITY);
    expect_hit(p, r, hit_at(2.0f, 0.25f, 0.5f), "direction (-0, 0, -1)");
}

static void a_parallel_ray_is_a_miss(void)
{
    ray above =
        ray_make(vec3_make(-1, 0.5f, 1), vec3_make(1, 0, 0), 0.0f, INFINITY);
    expect_miss(RIGHT_TRIANGLE, above, "the ray passes one above the plane");
    ray within =
        ray_make(vec3_make(-1, 0.5f, 0), vec3_make(1, 0, 0), 0.0f, INFINITY);
    expect_miss(RIGHT_TRIANGLE, within,
                "a ray in the triangle's plane sees it edge on: a miss");
}

static void equal_corners_are_never_hit(void)
{
    const vec3 point[3] = {{1, 1, 0}, {1, 1, 0}, {1, 1, 0}};
    const vec3 first_two[3] = {{0, 0, 0}, {0, 0, 0}, {0, 2, 0}};
    const vec3 last_two[3] = {{0, 0, 0}, {0, 2, 0}, {0, 2, 0}};
    expect_miss(point, down_at(1, 1), "the triangle is a point: no area");
    expect_miss(first_two, down_at(0, 1), "p0 = p1: the area is 0");
    expect_miss(last_two, down_at(0, 1), "p1 = p2: the area is 0");
}

static void corners_in_a_line_are_never_hit(void)
{
    const vec3 p[3] = {{0, 0, 0}, {1, 1, 0}, {2, 2, 0}};
    expect_miss(p, down_at(1, 1), "the ray meets the line, but it has no area");
    expect_miss(p, down_at(1, 0.5f), "the ray passes the line");
}

static void corners_that_are_not_finite_are_never_hit(void)
{
    for (int corner = 0; corner < 3; corner++) {
        vec3 p[3] = {RIGHT_TRIANGLE[0], RIGHT_TRIANGLE[1], RIGHT_TRIANGLE[2]};
        p[corner].x = NAN;
        expect_miss(p, down_at(0.5f, 0.5f), "a corner is NaN");
        p[corner].x = INFINITY;
        expect_miss(p, down_at(0.5f, 0.5f), "a corner is infinitely far");
    }
}

/* The right triangle with legs of the given size, seen from five sizes away. */
static void expect_hit_at_size(float size, const char *why)
{
    const vec3 p[3] = {{0, 0, 0}, {size, 0, 0}, {0, size, 0}};
    ray r = ray_make(vec3_make(size / 4, size / 4, size * 5),
                     vec3_make(0, 0, -1), 0.0f, INFINITY);
    expect_hit(p, r, hit_at(size * 5, 0.25f, 0.25f), why);
}

static void tiny_triangles_are_hit(void)
{
    expect_hit_at_size(1e-2f, "legs of 0.01: no size is special");
    expect_hit_at_size(1e-4f, "legs of 0.0001: no size is special");
}

static void huge_triangles_are_hit(void)
{
    expect_hit_at_size(1e2f, "legs of 100: no size is special");
    expect_hit_at_size(1e4f, "legs of 10000: no size is special");
}

static void a_miss_leaves_the_hit_alone(void)
{
    const struct triangle_hit before = hit_at(1.0f, 2.0f, 3.0f);
    struct triangle_hit hit = before;
    ray r = down_at(0.5f, 0.5f);
    r.t_max = 4.0f;
    triangle_intersect(RIGHT_TRIANGLE, &r, &hit);
    TEST_ASSERT_EQUAL_MEMORY_MESSAGE(&before, &hit, sizeof hit,
                                     "out of range: *hit must stay as it was");
    r = down_at(3.0f, 3.0f);
    triangle_intersect(RIGHT_TRIANGLE, &r, &hit);
    TEST_ASSERT_EQUAL_MEMORY_MESSAGE(&before, &hit, sizeof hit,
                                     "outside: *hit must stay as it was");
}

static void expect_vector(vec3 want, vec3 got, const char *which)
{
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(1e-4f, want.x, got.x, which);
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(1e-4f, want.y, got.y, which);
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(1e-4f, want.z, got.z, which);
}

static void expect_differentials(const vec2 uv[3], vec3 dp_du, vec3 dp_dv)
{
    vec3 u = {-7, -7, -7}, v = {-7, -7, -7};
    TEST_ASSERT_TRUE_MESSAGE(
        triangle_uv_differentials(RIGHT_TRIANGLE, uv, &u, &v),
        "these texture coordinates have an area: the answer exists");
    expect_vector(dp_du, u, "dp_du: how the point moves as u grows");
    expect_vector(dp_dv, v, "dp_dv: how the point moves as v grows");
}

static void expect_no_differentials(const vec2 uv[3], const char *why)
{
    const vec3 before = {1, 2, 3};
    vec3 u = before, v = before;
    TEST_ASSERT_FALSE_MESSAGE(
        triangle_uv_differentials(RIGHT_TRIANGLE, uv, &u, &v), why);
    TEST_ASSERT_EQUAL_MEMORY_MESSAGE(&before, &u, sizeof u,
                                     "*dp_du must stay as it was");
    TEST_ASSERT_EQUAL_MEMORY_MESSAGE(&before, &v, sizeof v,
                                     "*dp_dv must stay as it was");
}

static void uv_like_the_plane_gives_its_axes(void)
{
    const vec2 uv[3] = {{0, 0}, {2, 0}, {0, 2}};
    expect_differentials(uv, vec3_make(1, 0, 0), vec3_make(0, 1, 0));
}

static void uv_that_grow_faster_give_shorter_vectors(void)
{
    const vec2 uv[3] = {{0.25f, 0.5f}, {8.25f, 0.5f}, {0.25f, 1.0f}};
    expect_differentials(uv, vec3_make(0.25f, 0, 0), vec3_make(0, 4, 0));
}

static void mirrored_uv_give_mirrored_vectors(void)
{
    const vec2 uv[3] = {{1, 0}, {0, 0}, {1, 1}};
    expect_differentials(uv, vec3_make(-2, 0, 0), vec3_make(0, 2, 0));
}

static void skewed_uv_give_skewed_vectors(void)
{
    const vec2 uv[3] = {{0, 0}, {2, 0}, {1, 1}};
    expect_differentials(uv, vec3_make(1, 0, 0), vec3_make(-1, 2, 0));
}

static void exchanged_uv_exchange_the_vectors(void)
{
    const vec2 uv[3] = {{0, 0}, {0, 4}, {2, 0}};
    expect_differentials(uv, vec3_make(0, 1, 0), vec3_make(0.5f, 0, 0));
}

static void uv_without_area_have_no_differentials(void)
{
    const vec2 equal[3] = {{0.5f, 0.5f}, {0.5f, 0.5f}, {0.5f, 0.5f}};
    const vec2 in_a_line[3] = {{0, 0}, {1, 2}, {2, 4}};
    expect_no_differentials(equal, "all texture coordinates are equal");
    expect_no_differentials(in_a_line, "texture coordinates in a line");
}

static void uv_that_are_not_finite_have_no_differentials(void)
{
    const vec2 not_a_number[3] = {{0, 0}, {NAN, 0}, {0, 1}};
    const vec2 too_small[3] = {{0, 0}, {1e-39f, 0}, {0, 1}};
    expect_no_differentials(not_a_number, "a texture coordinate is NaN");
    expect_no_differentials(too_small, "dp_du would be 2e39: not finite");
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(a_ray_through_the_middle_hits);
    RUN_TEST(weights_belong_to_their_corners);
    RUN_TEST(the_back_is_hit_like_the_front);
    RUN_TEST(edges_belong_to_the_triangle);
    RUN_TEST(corners_belong_to_the_triangle);
    RUN_TEST(just_outside_an_edge_is_a_miss);
    RUN_TEST(the_other_half_of_the_square_is_a_miss);
    RUN_TEST(a_triangle_behind_the_ray_is_a_miss);
    RUN_TEST(t_min_itself_counts);
    RUN_TEST(t_max_itself_counts);
    RUN_TEST(t_counts_in_lengths_of_the_direction);
    RUN_TEST(a_slanted_ray_hits);
    RUN_TEST(rays_along_every_axis_hit);
    RUN_TEST(a_parallel_ray_is_a_miss);
    RUN_TEST(equal_corners_are_never_hit);
    RUN_TEST(corners_in_a_line_are_never_hit);
    RUN_TEST(corners_that_are_not_finite_are_never_hit);
    RUN_TEST(tiny_triangles_are_hit);
    RUN_TEST(huge_triangles_are_hit);
    RUN_TEST(a_miss_leaves_the_hit_alone);
    RUN_TEST(uv_like_the_plane_gives_its_axes);
    RUN_TEST(uv_that_grow_faster_give_shorter_vectors);
    RUN_TEST(mirrored_uv_give_mirrored_vectors);
    RUN_TEST(skewed_uv_give_skewed_vectors);
    RUN_TEST(exchanged_uv_exchange_the_vectors);
    RUN_TEST(uv_without_area_have_no_differentials);
    RUN_TEST(uv_that_are_not_finite_have_no_differentials);
    return UNITY_END();
}
