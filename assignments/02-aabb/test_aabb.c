/* test_aabb.c - the public tests of assignment 02.
 *
 * Most use one box, from (0, 0, 0) to (4, 2, 6), drawn here from the front:
 *
 *     (0,2) +--------+ (4,2)      z goes from 0 to 6, towards you.
 *           |        |
 *     (0,0) +--------+ (4,0)
 *
 * Read a test's name and its message; the contract is in accel/aabb.h. */
#include "accel/aabb.h"

#include "sampling/sampler.h"

#include "unity.h"

static const aabb BOX = {{0.0f, 0.0f, 0.0f}, {4.0f, 2.0f, 6.0f}};

void setUp(void)
{
}

void tearDown(void)
{
}

static ray ray_from(float ox, float oy, float oz, float dx, float dy, float dz)
{
    return ray_make(vec3_make(ox, oy, oz), vec3_make(dx, dy, dz), 0.0f,
                    INFINITY);
}

static void expect_hit(aabb box, ray r, float enter, float leave,
                       const char *why)
{
    float t_enter = -7.0f, t_exit = -7.0f;
    TEST_ASSERT_TRUE_MESSAGE(aabb_intersect(&box, &r, &t_enter, &t_exit), why);
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(1e-5f * fabsf(enter), enter, t_enter,
                                     "t_enter: where the ray comes in");
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(1e-5f * fabsf(leave), leave, t_exit,
                                     "t_exit: where the ray goes out");
}

static void expect_miss(aabb box, ray r, const char *why)
{
    float t_enter = -7.0f, t_exit = -7.0f;
    TEST_ASSERT_FALSE_MESSAGE(aabb_intersect(&box, &r, &t_enter, &t_exit), why);
}

/* Plain hits and misses --------------------------------------------------- */

static void a_ray_through_the_box_hits(void)
{
    expect_hit(BOX, ray_from(-2, 1, 3, 1, 0.25f, 0.5f), 2.0f, 4.0f,
               "it enters through x = 0 and leaves through y = 2");
    expect_hit(BOX, ray_from(2, 1, 10, 0.125f, 0.125f, -1), 4.0f, 8.0f,
               "it enters through z = 6 and leaves through y = 2");
}

/* For a direction component below zero the far plane comes first. */
static void every_sign_of_the_direction_works(void)
{
    for (int signs = 0; signs < 8; signs++) {
        float x = signs & 1 ? -1 : 1, y = signs & 2 ? -1 : 1;
        float z = signs & 4 ? -1 : 1;
        ray r = ray_from(2 - 10 * x, 1 - 10 * y, 3 - 10 * z, x, y, z);
        expect_hit(BOX, r, 9.0f, 11.0f,
                   "a diagonal through the middle, from each of 8 sides");
    }
}

static void a_ray_past_the_box_misses(void)
{
    expect_miss(BOX, ray_from(-2, 1, 3, 1, 1, 0),
                "it passes above: it leaves y before it enters x");
    expect_miss(BOX, ray_from(-2, 1, 3, 1, 0.125f, 2.5f),
                "it passes in front: it leaves z before it enters x");
    expect_miss(BOX, ray_from(5, -1, 3, 0.125f, 1, 0.125f),
                "it passes on the right");
}

static void t_counts_in_lengths_of_the_direction(void)
{
    expect_hit(BOX, ray_from(-2, 1, 3, 4, 0, 0), 0.5f, 1.5f,
               "a direction of length 4 needs a quarter of the t");
    expect_hit(BOX, ray_from(-2, 1, 3, 0.0625f, 0, 0), 32.0f, 96.0f,
               "a direction of length 1/16 needs 16 times the t");
}

/* The ray's range --------------------------------------------------------- */

static void an_origin_inside_enters_at_t_min(void)
{
    ray r = ray_from(1, 1, 3, 1, 0, 0);
    expect_hit(BOX, r, 0.0f, 3.0f, "it is inside already: t_enter is t_min");
    r.t_min = 0.5f;
    expect_hit(BOX, r, 0.5f, 3.0f, "it is inside already: t_enter is t_min");
}

static void the_answer_is_clipped_to_the_range(void)
{
    ray r = ray_from(-2, 1, 3, 1, 0, 0); /* in the box from t = 2 to 6 */
    r.t_min = 3.0f;
    r.t_max = 5.0f;
    expect_hit(BOX, r, 3.0f, 5.0f, "the range lies within the box");
    r.t_min = 1.0f;
    expect_hit(BOX, r, 2.0f, 5.0f, "only t_max clips");
    r.t_min = 3.0f;
    r.t_max = 9.0f;
    expect_hit(BOX, r, 3.0f, 6.0f, "only t_min clips");
}

static void a_box_behind_the_origin_is_a_miss(void)
{
    expect_miss(BOX, ray_from(6, 1, 3, 1, 0, 0), "it lies in -x");
    expect_miss(BOX, ray_from(2, -1, 3, 0.125f, -1, 0.25f), "it lies in +y");
}

static void a_box_out_of_the_range_is_a_miss(void)
{
    ray r = ray_from(-2, 1, 3, 1, 0, 0); /* in the box from t = 2 to 6 */
    r.t_max = 1.875f;
    expect_miss(BOX, r, "the range ends before the box");
    r.t_max = INFINITY;
    r.t_min = 6.125f;
    expect_miss(BOX, r, "the range begins behind the box");
}

static void a_range_that_just_touches_hits(void)
{
    ray r = ray_from(-2, 1, 3, 1, 0, 0); /* in the box from t = 2 to 6 */
    r.t_max = 2.0f;
    expect_hit(BOX, r, 2.0f, 2.0f, "the range is closed: t_max touches");
    r.t_max = INFINITY;
    r.t_min = 6.0f;
    expect_hit(BOX, r, 6.0f, 6.0f, "the range is closed: t_min touches");
}

static void the_order_of_the_answer_holds(void)
{
    for (uint64_t i = 0; i < 10000; i++) {
        struct sampler s = sampler_start(SAMPLER_INDEPENDENT, 1, 0, i, 1);
        vec2 a = sampler_2d(&s), b = sampler_2d(&s), c = sampler_2d(&s);
        ray r = ray_from(8 * a.x - 2, 6 * a.y - 2, 10 * b.x - 2, b.y - 0.5f,
                         c.x - 0.5f, c.y - 0.5f);
        r.t_min = 4 * sampler_1d(&s);
        r.t_max = r.t_min + 8 * sampler_1d(&s);
        float enter, leave;
        if (!aabb_intersect(&BOX, &r, &enter, &leave))
            continue;
        TEST_ASSERT_TRUE_MESSAGE(r.t_min <= enter, "t_min <= t_enter");
        TEST_ASSERT_TRUE_MESSAGE(enter <= leave, "t_enter <= t_exit");
        TEST_ASSERT_TRUE_MESSAGE(leave <= r.t_max, "t_exit <= t_max");
    }
}

/* Directions with zeros --------------------------------------------------- */

/* Rays along one axis: two components are zero, with all four signs of 0. */
static void zeros_of_both_signs_between_the_planes_hit(void)
{
    for (int signs = 0; signs < 4; signs++) {
        float a = signs & 1 ? -0.0f : 0.0f, b = signs & 2 ? -0.0f : 0.0f;
        expect_hit(BOX, ray_from(-2, 1, 3, 1, a, b), 2, 6, "along +x");
        expect_hit(BOX, ray_from(6, 1, 3, -1, a, b), 2, 6, "along -x");
        expect_hit(BOX, ray_from(2, -3, 3, a, 1, b), 3, 5, "along +y");
        expect_hit(BOX, ray_from(2, 5, 3, a, -1, b), 3, 5, "along -y");
        expect_hit(BOX, ray_from(2, 1, -1, a, b, 1), 1, 7, "along +z");
        expect_hit(BOX, ray_from(2, 1, 7, a, b, -1), 1, 7, "along -z");
    }
}

static void zeros_of_both_signs_outside_the_planes_miss(void)
{
    for (int sign = 0; sign < 2; sign++) {
        float zero = sign ? -0.0f : 0.0f;
        expect_miss(BOX, ray_from(-2, 3, 3, 1, zero, 0), "above the box");
        expect_miss(BOX, ray_from(-2, -1, 3, 1, zero, 0), "below the box");
        expect_miss(BOX, ray_from(-2, 1, 7, 1, 0, zero), "before the box");
        expect_miss(BOX, ray_from(-2, 1, -1, 1, 0, zero), "behind the box");
        expect_miss(BOX, ray_from(5, 1, -1, zero, 0, 1), "right of the box");
        expect_miss(BOX, ray_from(-1, 1, -1, zero, 0, 1), "left of the box");
        expect_miss(BOX, ray_from(-2, -1, 2, 1, zero, 0.125f),
                    "below the box, with one zero only");
    }
}

/* 0 * infinity is NaN: does it clip where it must not? The origin is on the
 * plane, which belongs to the box. */
static void zeros_on_a_plane_hit(void)
{
    for (int sign = 0; sign < 2; sign++) {
        float zero = sign ? -0.0f : 0.0f;
        expect_hit(BOX, ray_from(-2, 0, 3, 1, zero, 0), 2, 6, "in y = 0");
        expect_hit(BOX, ray_from(-2, 2, 3, 1, zero, 0), 2, 6, "in y = 2");
        expect_hit(BOX, ray_from(-2, 1, 0, 1, 0, zero), 2, 6, "in z = 0");
        expect_hit(BOX, ray_from(-2, 1, 6, 1, 0, zero), 2, 6, "in z = 6");
        expect_hit(BOX, ray_from(0, 1, -1, zero, 0, 1), 1, 7, "in x = 0");
        expect_hit(BOX, ray_from(4, 1, -1, zero, 0, 1), 1, 7, "in x = 4");
        expect_hit(BOX, ray_from(-2, 0, 3, 1, zero, 0.25f), 2, 6,
                   "in y = 0, with one zero only");
    }
}

static void zeros_along_an_edge_hit(void)
{
    for (int signs = 0; signs < 4; signs++) {
        float a = signs & 1 ? -0.0f : 0.0f, b = signs & 2 ? -0.0f : 0.0f;
        expect_hit(BOX, ray_from(-2, 2, 6, 1, a, b), 2, 6, "upper edge");
        expect_hit(BOX, ray_from(-2, 0, 0, 1, a, b), 2, 6, "lower edge");
        expect_hit(BOX, ray_from(4, -3, 0, a, 1, b), 3, 5, "right edge");
    }
}

static void zeros_with_the_origin_inside_hit(void)
{
    for (int signs = 0; signs < 4; signs++) {
        float a = signs & 1 ? -0.0f : 0.0f, b = signs & 2 ? -0.0f : 0.0f;
        expect_hit(BOX, ray_from(1, 1, 3, 1, a, b), 0, 3, "from inside");
        expect_hit(BOX, ray_from(0, 0, 0, 1, a, b), 0, 4, "from a corner");
        expect_miss(BOX, ray_from(5, 1, 3, 1, a, b), "it lies behind");
    }
}

/* Touching ---------------------------------------------------------------- */

static void touching_an_edge_or_a_corner_hits(void)
{
    expect_hit(BOX, ray_from(-1, 1, 3, 1, 1, 0), 1.0f, 1.0f,
               "it touches the edge x = 0, y = 2");
    expect_hit(BOX, ray_from(-1, 1, 5, 1, 1, 1), 1.0f, 1.0f,
               "it touches the corner (0, 2, 6)");
    expect_hit(BOX, ray_from(3, -1, -1, 1, 1, 1), 1.0f, 1.0f,
               "it touches the edge y = 0, z = 0 at its end");
}

static void an_origin_on_a_face_hits(void)
{
    expect_hit(BOX, ray_from(0, 1, 3, 1, 0.125f, 0.25f), 0.0f, 4.0f,
               "it starts on x = 0 and goes in");
    expect_hit(BOX, ray_from(0, 1, 3, -1, 0.125f, 0.25f), 0.0f, 0.0f,
               "it starts on x = 0 and goes out: it touches");
}

/* Flat and empty boxes ---------------------------------------------------- */

static void a_flat_box_is_a_rectangle(void)
{
    const aabb wall = {{2, 0, 0}, {2, 2, 6}};
    expect_hit(wall, ray_from(0, 0.5f, 1, 1, 0.25f, 0.5f), 2.0f, 2.0f,
               "through a wall without thickness");
    expect_hit(wall, ray_from(5, 1, 3, -1, -0.0f, 0), 3.0f, 3.0f,
               "straight through it");
    expect_miss(wall, ray_from(0, 1.5f, 1, 1, 0.5f, 0.5f), "past the wall");
    const aabb floor = {{0, -1, 0}, {4, -1, 6}};
    expect_hit(floor, ray_from(1, 1, 1, 0.25f, -0.5f, 0.25f), 4.0f, 4.0f,
               "through a floor without thickness");
}

/* The plane of the flat box and the ray coincide: 0 * infinity twice. */
static void a_flat_box_is_hit_along_its_plane(void)
{
    const aabb wall = {{2, 0, 0}, {2, 2, 6}};
    for (int sign = 0; sign < 2; sign++) {
        float zero = sign ? -0.0f : 0.0f;
        expect_hit(wall, ray_from(2, -1, 3, zero, 1, 0), 1, 3,
                   "edge on, in the wall's plane");
        expect_miss(wall, ray_from(1, -1, 3, zero, 1, 0), "beside the wall");
        expect_miss(wall, ray_from(3, -1, 3, zero, 1, 0), "beside the wall");
    }
}

static void segments_and_points_are_boxes_too(void)
{
    const aabb segment = {{2, 1, 0}, {2, 1, 6}}, point = {{2, 1, 3}, {2, 1, 3}};
    expect_hit(segment, ray_from(0, 1, 3, 1, 0, 0), 2, 2, "a segment");
    expect_hit(segment, ray_from(2, 1, 9, 0, -0.0f, -1), 3, 9, "along it");
    expect_hit(point, ray_from(0, 1, 3, 1, 0, -0.0f), 2, 2, "a point");
    expect_hit(point, ray_from(0, -1, 1, 1, 1, 1), 2, 2, "a point, aslant");
    expect_miss(point, ray_from(0, 1, 3.125f, 1, 0, 0), "past the point");
}

static void the_empty_box_is_never_hit(void)
{
    expect_miss(aabb_empty(), ray_from(0, 0, 0, 1, 0, 0), "along x");
    expect_miss(aabb_empty(), ray_from(0, 0, 0, -0.0f, -1, 0), "along -y");
    expect_miss(aabb_empty(), ray_from(1, 2, 3, 1, -1, 0.5f), "aslant");
}

/* No size is special ------------------------------------------------------ */

static void every_size_of_box_is_hit(void)
{
    for (int k = -6; k <= 6; k++) {
        float s = powf(10.0f, (float)k);
        const aabb box = {{0, 0, 0}, {4 * s, 2 * s, 6 * s}};
        ray r = ray_from(-2 * s, s, 3 * s, 1, 0.25f, 0.5f);
        expect_hit(box, r, 2 * s, 4 * s, "sizes from 1e-6 to 1e6");
        expect_miss(box, ray_from(-2 * s, s, 3 * s, 1, 1, 0),
                    "sizes from 1e-6 to 1e6");
    }
}

/* Against long double ------------------------------------------------------
 *
 * Slabs in long double, from the same numbers: the ray is in the box from
 * enter to leave. */

struct span {
    long double enter, leave;
};

static void clip_exactly(double lower, double upper, double origin,
                         double direction, struct span *s)
{
    long double a = ((long double)lower - origin) / direction;
    long double b = ((long double)upper - origin) / direction;
    s->enter = fmaxl(s->enter, fminl(a, b));
    s->leave = fminl(s->leave, fmaxl(a, b));
}

/* No component of the direction may be 0. */
static struct span exact_span(aabb box, ray r)
{
    struct span s = {r.t_min, r.t_max};
    clip_exactly(box.lower.x, box.upper.x, r.origin.x, r.direction.x, &s);
    clip_exactly(box.lower.y, box.upper.y, r.origin.y, r.direction.y, &s);
    clip_exactly(box.lower.z, box.upper.z, r.origin.z, r.direction.z, &s);
    return s;
}

static float random_between(struct sampler *s, float from, float to)
{
    return from + (to - from) * sampler_1d(s);
}

static vec3 random_vector(struct sampler *s, float from, float to)
{
    float x = random_between(s, from, to), y = random_between(s, from, to);
    return vec3_make(x, y, random_between(s, from, to));
}

/* Some sides are a thousand times thinner than others. */
static aabb random_box(struct sampler *s)
{
    float size = powf(10.0f, random_between(s, -3, 3));
    vec3 corner = random_vector(s, -size, size);
    vec3 extent = random_vector(s, 0, size);
    if (sampler_1d(s) < 0.3f)
        extent.x *= 1e-3f;
    if (sampler_1d(s) < 0.3f)
        extent.y *= 1e-3f;
    aabb box = {corner, vec3_add(corner, extent)};
    return box;
}

/* Towards a point in the box, from a few sizes away. */
static ray random_ray_towards(struct sampler *s, aabb box)
{
    vec3 extent = vec3_sub(box.upper, box.lower);
    vec3 aim = vec3_make(box.lower.x + extent.x * sampler_1d(s),
                         box.lower.y + extent.y * sampler_1d(s),
                         box.lower.z + extent.z * sampler_1d(s));
    float away = 4.0f * vec3_length(extent);
    vec3 from = vec3_add(aim, random_vector(s, -away, away));
    return ray_make(from, vec3_sub(aim, from), 0.0f, INFINITY);
}

/* The same towards a point on an edge: the ray is in the box for a very short
 * time, if at all, and rounding can turn t_enter and t_exit round. */
static ray random_ray_towards_an_edge(struct sampler *s, aabb box)
{
    int edge = (int)(4.0f * sampler_1d(s));
    vec3 extent = vec3_sub(box.upper, box.lower);
    vec3 aim = vec3_make(edge & 1 ? box.upper.x : box.lower.x,
                         edge & 2 ? box.upper.y : box.lower.y,
                         box.lower.z + extent.z * sampler_1d(s));
    float away = 4.0f * vec3_length(extent);
    vec3 from = vec3_add(aim, random_vector(s, -away, away));
    return ray_make(from, vec3_sub(aim, from), 0.0f, INFINITY);
}

static bool has_a_zero(vec3 v)
{
    return v.x == 0.0f || v.y == 0.0f || v.z == 0.0f;
}

static void no_box_that_is_crossed_is_ever_lost(void)
{
    for (uint64_t i = 0; i < 200000; i++) {
        struct sampler s = sampler_start(SAMPLER_INDEPENDENT, 2, 0, i, 1);
        aabb box = random_box(&s);
        ray r = i % 2 ? random_ray_towards(&s, box)
                      : random_ray_towards_an_edge(&s, box);
        float enter, leave;
        if (has_a_zero(r.direction))
            continue;
        struct span exact = exact_span(box, r);
        if (!(exact.enter < exact.leave))
            continue;
        TEST_ASSERT_TRUE_MESSAGE(
            aabb_intersect(&box, &r, &enter, &leave),
            "the ray crosses the inside of the box: a BVH would lose what is "
            "in it (rounding makes t_enter > t_exit)");
    }
}

static void boxes_that_are_passed_by_are_missed(void)
{
    for (uint64_t i = 0; i < 100000; i++) {
        struct sampler s = sampler_start(SAMPLER_INDEPENDENT, 3, 0, i, 1);
        aabb box = random_box(&s);
        ray r = random_ray_towards(&s, box);
        vec3 extent = vec3_sub(box.upper, box.lower);
        float away = 2.0f * vec3_length(extent);
        r = ray_make(vec3_add(r.origin, random_vector(&s, -away, away)),
                     r.direction, 0.0f, INFINITY);
        float enter, leave;
        if (has_a_zero(r.direction))
            continue;
        struct span exact = exact_span(box, r);
        if (!(exact.enter > exact.leave * (1 + 1e-5L) + 1e-30L))
            continue;
        TEST_ASSERT_FALSE_MESSAGE(aabb_intersect(&box, &r, &enter, &leave),
                                  "the ray passes the box by more than "
                                  "rounding");
    }
}

static void entry_and_exit_match(void)
{
    for (uint64_t i = 0; i < 100000; i++) {
        struct sampler s = sampler_start(SAMPLER_INDEPENDENT, 4, 0, i, 1);
        aabb box = random_box(&s);
        ray r = random_ray_towards(&s, box);
        float enter = -7.0f, leave = -7.0f;
        if (has_a_zero(r.direction) ||
            !aabb_intersect(&box, &r, &enter, &leave))
            continue;
        struct span exact = exact_span(box, r);
        TEST_ASSERT_TRUE_MESSAGE(fabsl(enter - exact.enter) <=
                                     1e-5L * fabsl(exact.enter),
                                 "t_enter is right to five digits");
        TEST_ASSERT_TRUE_MESSAGE(fabsl(leave - exact.leave) <=
                                     1e-5L * fabsl(exact.leave),
                                 "t_exit is right to five digits");
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(a_ray_through_the_box_hits);
    RUN_TEST(every_sign_of_the_direction_works);
    RUN_TEST(a_ray_past_the_box_misses);
    RUN_TEST(t_counts_in_lengths_of_the_direction);
    RUN_TEST(an_origin_inside_enters_at_t_min);
    RUN_TEST(the_answer_is_clipped_to_the_range);
    RUN_TEST(a_box_behind_the_origin_is_a_miss);
    RUN_TEST(a_box_out_of_the_range_is_a_miss);
    RUN_TEST(a_range_that_just_touches_hits);
    RUN_TEST(the_order_of_the_answer_holds);
    RUN_TEST(zeros_of_both_signs_between_the_planes_hit);
    RUN_TEST(zeros_of_both_signs_outside_the_planes_miss);
    RUN_TEST(zeros_on_a_plane_hit);
    RUN_TEST(zeros_along_an_edge_hit);
    RUN_TEST(zeros_with_the_origin_inside_hit);
    RUN_TEST(touching_an_edge_or_a_corner_hits);
    RUN_TEST(an_origin_on_a_face_hits);
    RUN_TEST(a_flat_box_is_a_rectangle);
    RUN_TEST(a_flat_box_is_hit_along_its_plane);
    RUN_TEST(segments_and_points_are_boxes_too);
    RUN_TEST(the_empty_box_is_never_hit);
    RUN_TEST(every_size_of_box_is_hit);
    RUN_TEST(no_box_that_is_crossed_is_ever_lost);
    RUN_TEST(boxes_that_are_passed_by_are_missed);
    RUN_TEST(entry_and_exit_match);
    return UNITY_END();
}
