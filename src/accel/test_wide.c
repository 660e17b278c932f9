/* test_wide.c - the wide tree holds what it was given and finds what testing
 * everything finds. */
#include "accel/wide.h"

#include <stdlib.h>
#include <string.h>

#ifdef _OPENMP
#include <omp.h>
#endif

#include "accel/aabb.h"
#include "base/counters.h"
#include "sampling/random.h"
#include "shapes/triangle.h"
#include "unity.h"

enum { MOST = 60000, RAYS = 3000 };

/* Primitives: triangles, but every others-th (0: none) is its own box, which a
 * ray hits where it enters it. */
struct things {
    uint32_t count, others;
    vec3 corners[MOST][3];
};

static struct things things;
static struct wide tree;

void setUp(void)
{
    memset(&tree, 0, sizeof tree);
}

void tearDown(void)
{
    wide_free(&tree);
}

static bool is_other(const struct things *t, uint32_t i)
{
    return t->others > 0 && i % t->others == 0;
}

static bool corners_of(const void *context, uint32_t i, vec3 corners[3])
{
    const struct things *t = context;
    memcpy(corners, t->corners[i], sizeof t->corners[i]);
    return !is_other(t, i);
}

static aabb box_of(const void *context, uint32_t i)
{
    const vec3 *p = ((const struct things *)context)->corners[i];
    return aabb_include(aabb_include(aabb_include(aabb_empty(), p[0]), p[1]),
                        p[2]);
}

static bool test_other(const void *context, uint32_t i, uint32_t count, ray *r,
                       void *hit)
{
    const struct things *t = context;
    struct nearest found = {.primitive = i};
    aabb box = box_of(t, i);
    float leave;
    TEST_ASSERT_EQUAL_UINT32(1, count);
    TEST_ASSERT_TRUE(is_other(t, i));
    return aabb_intersect(&box, r, &found.t, &leave) &&
           nearest_offer(hit, &found, r);
}

static struct wide build(void)
{
    const struct wide_source source = {things.count, NULL, &things, corners_of,
                                       box_of};
    return wide_build(&source);
}

static vec3 random_vec(uint64_t key, uint32_t first)
{
    return vec3_make(random_float(key, first) - 0.5f,
                     random_float(key, first + 1) - 0.5f,
                     random_float(key, first + 2) - 0.5f);
}

/* Small triangles in a cube of that size around a place. */
static void scatter(uint32_t count, vec3 place, float size)
{
    things.count = count;
    things.others = 0;
    for (uint32_t i = 0; i < count; i++) {
        uint64_t key = random_key(11, i, 0);
        vec3 at = vec3_step(place, size, random_vec(key, 0));
        for (uint32_t k = 0; k < 3; k++)
            things.corners[i][k] =
                vec3_step(at, 0.2f * size, random_vec(key, 3 + 3 * k));
    }
}

static ray random_ray(uint32_t i, vec3 place, float size)
{
    uint64_t key = random_key(12, i, 0);
    vec3 from = vec3_step(place, 2.0f * size, random_vec(key, 0));
    vec3 along = random_vec(key, 3);
    if (i % 4 == 1)
        along.x = i % 8 == 1 ? 0.0f : -0.0f;
    if (i % 16 == 5)
        along.z = 0.0f;
    return ray_make(from, along, 0.0f, i % 3 == 0 ? 1.5f * size : INFINITY);
}

/* What wide_nearest must find, by asking everything. */
static bool ask_everything(ray r, struct nearest *best)
{
    bool found = false;
    for (uint32_t i = 0; i < things.count; i++) {
        struct triangle_hit hit;
        if (is_other(&things, i)) {
            found = test_other(&things, i, 1, &r, best) || found;
        } else if (triangle_intersect(things.corners[i], &r, &hit)) {
            struct nearest offered = {i, hit.t, hit.b1, hit.b2};
            found = nearest_offer(best, &offered, &r) || found;
        }
    }
    return found;
}

/* Both queries with one ray; returns whether anything is hit. */
static bool compare(ray r)
{
    struct nearest want = {NO_PRIMITIVE, r.t_max, 0.0f, 0.0f};
    struct nearest got = want, limit = want;
    r.t_max = a_little_beyond(r.t_max);
    ray near = r, any = r;
    bool hit = ask_everything(r, &want);
    TEST_ASSERT_EQUAL(hit,
                      wide_nearest(&tree, &near, test_other, &things, &got));
    TEST_ASSERT_EQUAL_UINT32(want.primitive, got.primitive);
    TEST_ASSERT_EQUAL_MEMORY(&want, &got, sizeof want);
    TEST_ASSERT_EQUAL(hit, wide_any(&tree, &any, test_other, &things, &limit));
    return hit;
}

static void compare_many(vec3 place, float size)
{
    int hits = 0;
    tree = build();
    for (uint32_t i = 0; i < RAYS; i++)
        hits += compare(random_ray(i, place, size));
    TEST_ASSERT_TRUE(hits > RAYS / 20 && hits < RAYS);
}

static void triangles_are_found_to_the_last_bit(void)
{
    scatter(700, vec3_make(0, 0, 0), 1.0f);
    compare_many(vec3_make(0, 0, 0), 1.0f);
}

static void far_from_the_origin_too(void)
{
    vec3 place = vec3_make(3000.0f, -2000.0f, 500.0f);
    scatter(300, place, 1.0f);
    compare_many(place, 1.0f);
}

static void other_primitives_are_asked_about(void)
{
    scatter(500, vec3_make(0, 0, 0), 1.0f);
    things.others = 5;
    compare_many(vec3_make(0, 0, 0), 1.0f);
}

static void only_others_will_do(void)
{
    scatter(300, vec3_make(0, 0, 0), 1.0f);
    things.others = 1;
    compare_many(vec3_make(0, 0, 0), 1.0f);
}

/* Out of a float's reach: every triangle is asked. */
static void huge_and_tiny_numbers_are_no_exception(void)
{
    scatter(500, vec3_make(0, 0, 0), 1e20f);
    compare_many(vec3_make(0, 0, 0), 1e20f);
    wide_free(&tree);
    scatter(500, vec3_make(0, 0, 0), 1e-15f);
    compare_many(vec3_make(0, 0, 0), 1e-15f);
}

/* A grid of right angles, whose edges and diagonals rays of whole numbers meet
 * exactly: the first of the triangles that share them is hit. */
static void the_first_of_equals_is_hit(void)
{
    int hits = 0;
    things.others = 0;
    things.count = 0;
    for (int i = 0; i < 128; i++) {
        float x = (float)(i % 8), y = (float)(i / 8 % 8);
        vec3 *p = things.corners[things.count++];
        p[0] = vec3_make(x, y, 0);
        p[1] = vec3_make(x + 1, y + 1, 0);
        p[2] = i < 64 ? vec3_make(x + 1, y, 0) : vec3_make(x, y + 1, 0);
    }
    tree = build();
    for (int i = 0; i < 17 * 17; i++) {
        vec3 from =
            vec3_make(0.5f * (float)(i % 17), 0.5f * (float)(i / 17), 4.0f);
        hits += compare(ray_make(from, vec3_make(0, 0, -1), 0, INFINITY));
        hits += compare(ray_make(from, vec3_make(0, 0, -1), 0, 4.0f));
    }
    TEST_ASSERT_EQUAL_INT(2 * 17 * 17, hits);
}

static void copies_of_one_triangle_are_one(void)
{
    scatter(1, vec3_make(0, 0, 0), 1.0f);
    things.count = 100;
    for (uint32_t i = 1; i < things.count; i++)
        memcpy(things.corners[i], things.corners[0], sizeof things.corners[0]);
    tree = build();
    const vec3 *p = things.corners[0];
    vec3 middle = vec3_scale(vec3_add(vec3_add(p[0], p[1]), p[2]), 1.0f / 3.0f);
    vec3 from = vec3_make(1, 2, 3);
    ray r = ray_make(from, vec3_sub(middle, from), 0, INFINITY);
    struct nearest hit = {NO_PRIMITIVE, INFINITY, 0, 0};
    TEST_ASSERT_TRUE(wide_nearest(&tree, &r, test_other, &things, &hit));
    TEST_ASSERT_EQUAL_UINT32(0, hit.primitive);
}

static void nothing_is_hit_in_nothing(void)
{
    things.count = 0;
    tree = build();
    ray r = random_ray(0, vec3_make(0, 0, 0), 1.0f);
    struct nearest hit = {NO_PRIMITIVE, INFINITY, 0, 0};
    TEST_ASSERT_FALSE(wide_nearest(&tree, &r, test_other, &things, &hit));
    TEST_ASSERT_FALSE(wide_any(&tree, &r, test_other, &things, &hit));
}

/* The tree itself --------------------------------------------------------- */

static bool holds(const aabb *outer, const aabb *inner)
{
    return outer->lower.x <= inner->lower.x &&
           outer->lower.y <= inner->lower.y &&
           outer->lower.z <= inner->lower.z &&
           outer->upper.x >= inner->upper.x &&
           outer->upper.y >= inner->upper.y && outer->upper.z >= inner->upper.z;
}

static aabb child_box(const struct wide_node *n, int lane)
{
    aabb box = {
        vec3_make(n->planes[0][lane], n->planes[2][lane], n->planes[4][lane]),
        vec3_make(n->planes[1][lane], n->planes[3][lane], n->planes[5][lane])};
    return box;
}

static bool seen[MOST];
static uint32_t nodes_seen, packs_seen;

static void check_pack(uint32_t child, const aabb *box)
{
    const struct wide_pack *p = &tree.packs[child & WIDE_INDEX];
    bool others = false;
    TEST_ASSERT_EQUAL_UINT32(packs_seen++, child & WIDE_INDEX);
    for (int lane = 0; lane < WIDE; lane++) {
        uint32_t i = p->primitive[lane];
        bool empty = i == NO_PRIMITIVE;
        bool triangle = !empty && !is_other(&things, i);
        TEST_ASSERT_EQUAL(!triangle, isnan(p->corner[2][1][lane]));
        if (empty)
            continue;
        TEST_ASSERT_TRUE(i < things.count && !seen[i]);
        seen[i] = true;
        others = others || !triangle;
        aabb own = box_of(&things, i);
        TEST_ASSERT_TRUE(holds(box, &own));
        if (triangle)
            TEST_ASSERT_EQUAL_FLOAT(things.corners[i][2].y,
                                    p->corner[2][1][lane]);
    }
    TEST_ASSERT_EQUAL(others, (child & WIDE_OTHER) != 0);
    TEST_ASSERT_TRUE(!others || p->primitive[1] == NO_PRIMITIVE);
}

static void check(uint32_t child, const aabb *box, int depth)
{
    TEST_ASSERT_TRUE(depth <= WIDE_MAX_DEPTH);
    if (child & WIDE_LEAF) {
        check_pack(child, box);
        return;
    }
    int children = 0;
    TEST_ASSERT_EQUAL_UINT32(nodes_seen++, child);
    for (int i = 0; i < WIDE; i++) {
        aabb below = child_box(&tree.nodes[child], i);
        if (below.lower.x > below.upper.x)
            continue;
        children++;
        TEST_ASSERT_TRUE(holds(box, &below));
        check(tree.nodes[child].child[i], &below, depth + 1);
    }
    TEST_ASSERT_TRUE(children >= 2);
}

/* Builds it, and looks at every node and pack. */
static void check_tree(void)
{
    wide_free(&tree);
    memset(seen, 0, sizeof seen);
    nodes_seen = packs_seen = 0;
    tree = build();
    check(tree.root, &tree.box, 1);
    TEST_ASSERT_EQUAL_UINT32(tree.node_count, nodes_seen);
    TEST_ASSERT_EQUAL_UINT32(tree.pack_count, packs_seen);
    for (uint32_t i = 0; i < things.count; i++)
        TEST_ASSERT_TRUE(seen[i]);
}

static void every_primitive_is_in_one_lane(void)
{
    const uint32_t counts[] = {1, 2, 7, 8, 9, 16, 17, 100, 3000};
    for (size_t i = 0; i < sizeof counts / sizeof counts[0]; i++) {
        scatter(counts[i], vec3_make(0, 0, 0), 1.0f);
        things.others = i % 2 ? 7 : 0;
        check_tree();
    }
}

/* Packs are well filled, and nodes are few. */
static void a_tree_is_small(void)
{
    scatter(MOST, vec3_make(0, 0, 0), 1.0f);
    check_tree();
    double bytes = (double)tree.pack_count * sizeof *tree.packs +
                   (double)tree.node_count * sizeof *tree.nodes;
    TEST_ASSERT_TRUE(bytes < 55.0 * MOST);
}

static void equal_primitives_are_halved(void)
{
    scatter(1, vec3_make(0, 0, 0), 1.0f);
    things.count = MOST;
    for (uint32_t i = 1; i < MOST; i++)
        memcpy(things.corners[i], things.corners[0], sizeof things.corners[0]);
    check_tree();
}

/* Each is twice as large as the one before: the heuristic would split off one
 * at a time. Then sizes beyond what sums and areas can hold. */
static void depth_is_bounded_whatever_the_sizes(void)
{
    things.others = 0;
    things.count = 4000;
    for (uint32_t i = 0; i < things.count; i++) {
        float size = ldexpf(1.0f, (int)(i % 100) - 50);
        for (int k = 0; k < 3; k++)
            things.corners[i][k] =
                vec3_make(size * (k == 1 ? 2.0f : 1.0f),
                          size * (k == 2 ? 2.0f : 1.0f), size);
    }
    check_tree();
    for (uint32_t i = 0; i < things.count; i++)
        for (int k = 0; k < 3; k++)
            things.corners[i][k] = vec3_scale(things.corners[i][k], 1e14f);
    check_tree();
}

static void coordinates_without_measure_end_the_build_too(void)
{
    const struct wide_source source = {100, NULL, &things, corners_of, box_of};
    scatter(100, vec3_make(0, 0, 0), 1e38f);
    tree = wide_build(&source);
    TEST_ASSERT_TRUE(tree.pack_count >= 100 / WIDE);
}

#ifdef _OPENMP
static void any_number_of_threads_builds_the_same_tree(void)
{
    scatter(MOST, vec3_make(0, 0, 0), 1.0f);
    int before = omp_get_max_threads();
    omp_set_num_threads(1);
    tree = build();
    for (int threads = 2; threads <= 5; threads++) {
        omp_set_num_threads(threads);
        struct wide other = build();
        TEST_ASSERT_EQUAL_UINT32(tree.node_count, other.node_count);
        TEST_ASSERT_EQUAL_UINT32(tree.pack_count, other.pack_count);
        TEST_ASSERT_EQUAL(0, memcmp(tree.nodes, other.nodes,
                                    tree.node_count * sizeof *tree.nodes));
        TEST_ASSERT_EQUAL(0, memcmp(tree.packs, other.packs,
                                    tree.pack_count * sizeof *tree.packs));
        wide_free(&other);
    }
    omp_set_num_threads(before);
}
#endif

/* Eight boxes a node, eight primitives a pack, and few of both. */
static void work_is_counted(void)
{
    scatter(MOST, vec3_make(0, 0, 0), 1.0f);
    tree = build();
    struct counters before = counters_mine;
    for (uint32_t i = 0; i < RAYS; i++) {
        struct nearest hit = {NO_PRIMITIVE, INFINITY, 0, 0};
        ray r = random_ray(i, vec3_make(0, 0, 0), 1.0f);
        wide_nearest(&tree, &r, test_other, &things, &hit);
    }
    uint64_t boxes = counters_mine.boxes_tested - before.boxes_tested;
    uint64_t leaves = counters_mine.leaves_visited - before.leaves_visited;
    uint64_t tested =
        counters_mine.primitives_tested - before.primitives_tested;
    TEST_ASSERT_EQUAL(0, boxes % WIDE);
    TEST_ASSERT_EQUAL(WIDE * leaves, tested);
    TEST_ASSERT_TRUE(leaves > RAYS / 4);
    TEST_ASSERT_TRUE(boxes + tested < (uint64_t)RAYS * MOST / 20);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(triangles_are_found_to_the_last_bit);
    RUN_TEST(far_from_the_origin_too);
    RUN_TEST(other_primitives_are_asked_about);
    RUN_TEST(only_others_will_do);
    RUN_TEST(huge_and_tiny_numbers_are_no_exception);
    RUN_TEST(the_first_of_equals_is_hit);
    RUN_TEST(copies_of_one_triangle_are_one);
    RUN_TEST(nothing_is_hit_in_nothing);
    RUN_TEST(every_primitive_is_in_one_lane);
    RUN_TEST(a_tree_is_small);
    RUN_TEST(equal_primitives_are_halved);
    RUN_TEST(depth_is_bounded_whatever_the_sizes);
    RUN_TEST(coordinates_without_measure_end_the_build_too);
#ifdef _OPENMP
    RUN_TEST(any_number_of_threads_builds_the_same_tree);
#endif
    RUN_TEST(work_is_counted);
    return UNITY_END();
}
