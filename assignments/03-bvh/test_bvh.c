/* test_bvh.c - the public tests of assignment 03.
 *
 * The tree is built over the boxes of balls; each ball is a little smaller
 * than its box, so that no ball is hit where its box is not. What testing
 * every ball finds is what the tree must find.
 *
 * Read a test's name and its message; the contract is in accel/bvh.h. */
#include "accel/bvh.h"

#include <stdlib.h>
#include <string.h>

#include "accel/aabb.h"
#include "base/counters.h"
#include "sampling/sampler.h"

#include "unity.h"

/* One set of primitives at a time, its tree, and the work done on it. */
static aabb *boxes;
static struct bvh_node *nodes;
static uint32_t *permutation;
static uint32_t count;
static struct bvh tree;
static uint64_t leaves_tested, balls_tested;

void setUp(void)
{
    boxes = NULL;
    nodes = NULL;
    permutation = NULL;
    count = 0;
}

void tearDown(void)
{
    free(boxes);
    free(nodes);
    free(permutation);
}

/* Making sets of boxes ----------------------------------------------------- */

static void make_room(uint32_t n)
{
    tearDown();
    count = n;
    boxes = calloc(n + 1, sizeof *boxes);
    nodes = calloc(n > 1 ? 2 * (size_t)n - 1 : 1, sizeof *nodes);
    permutation = malloc((n + 1) * sizeof *permutation);
    TEST_ASSERT_TRUE(boxes != NULL && nodes != NULL && permutation != NULL);
    memset(permutation, 0xff, (n + 1) * sizeof *permutation);
}

static aabb box_around(vec3 center, float half)
{
    vec3 h = vec3_make(half, half, half);
    aabb box = {vec3_sub(center, h), vec3_add(center, h)};
    return box;
}

static vec3 random_point(struct sampler *s, float size)
{
    float x = sampler_1d(s), y = sampler_1d(s), z = sampler_1d(s);
    return vec3_make(size * (2 * x - 1), size * (2 * y - 1),
                     size * (2 * z - 1));
}

/* n boxes with half sides up to `half`, spread over [-size, size]^3. */
static void make_random(uint32_t n, float size, float half)
{
    make_room(n);
    for (uint32_t i = 0; i < n; i++) {
        struct sampler s = sampler_start(SAMPLER_INDEPENDENT, 1, n, i, 1);
        vec3 center = random_point(&s, size);
        boxes[i] = box_around(center, half * (0.1f + 0.9f * sampler_1d(&s)));
    }
}

static void build(void)
{
    tree.nodes = nodes;
    tree.node_count = bvh_build(boxes, count, nodes, permutation);
}

/* Is the tree one? --------------------------------------------------------- */

static void expect_inside(aabb inner, aabb outer, const char *why)
{
    TEST_ASSERT_TRUE_MESSAGE(
        outer.lower.x <= inner.lower.x && outer.lower.y <= inner.lower.y &&
            outer.lower.z <= inner.lower.z && inner.upper.x <= outer.upper.x &&
            inner.upper.y <= outer.upper.y && inner.upper.z <= outer.upper.z,
        why);
}

static void check_order(void)
{
    unsigned char *seen = calloc(count + 1, 1);
    for (uint32_t i = 0; i < count; i++) {
        TEST_ASSERT_TRUE_MESSAGE(permutation[i] < count,
                                 "permutation[] names primitives 0 to n - 1");
        TEST_ASSERT_FALSE_MESSAGE(seen[permutation[i]],
                                  "permutation[] names a primitive twice");
        seen[permutation[i]] = 1;
    }
    free(seen);
}

/* Notes that the leaf holds its places of permutation[]. */
static void check_leaf(const struct bvh_node *leaf, unsigned char *held)
{
    TEST_ASSERT_TRUE_MESSAGE(leaf->first < count &&
                                 leaf->count <= count - leaf->first,
                             "a leaf's range lies within permutation[]");
    TEST_ASSERT_TRUE_MESSAGE(leaf->count <= BVH_MAX_LEAF,
                             "no leaf holds more than BVH_MAX_LEAF");
    for (uint32_t i = leaf->first; i < leaf->first + leaf->count; i++) {
        TEST_ASSERT_FALSE_MESSAGE(held[i], "a primitive is in two leaves");
        held[i] = 1;
        expect_inside(boxes[permutation[i]], leaf->box,
                      "a leaf's box holds its primitives' boxes");
    }
}

static void check_children(const struct bvh_node *node, unsigned char *parented)
{
    TEST_ASSERT_TRUE_MESSAGE(node->first > 0 &&
                                 node->first < tree.node_count - 1,
                             "children lie within nodes[], behind the root");
    for (uint32_t child = node->first; child <= node->first + 1; child++) {
        TEST_ASSERT_FALSE_MESSAGE(parented[child], "a node has two parents");
        parented[child] = 1;
        expect_inside(nodes[child].box, node->box,
                      "a node's box holds its children's boxes");
    }
}

/* Walks down from the root. No node is visited twice, as none has two parents,
 * so this ends; one node a level waits. Returns how many nodes there are. */
static uint32_t check_nodes(unsigned char *held, unsigned char *parented)
{
    struct {
        uint32_t index;
        int depth;
    } waiting[BVH_MAX_DEPTH + 1] = {{0, 1}};
    uint32_t visited = 0;
    for (int size = 1; size > 0; visited++) {
        uint32_t node = waiting[--size].index;
        int depth = waiting[size].depth;
        TEST_ASSERT_TRUE_MESSAGE(depth <= BVH_MAX_DEPTH,
                                 "no leaf is deeper than BVH_MAX_DEPTH");
        if (nodes[node].count > 0) {
            check_leaf(&nodes[node], held);
            continue;
        }
        check_children(&nodes[node], parented);
        for (uint32_t i = 0; i < 2; i++) {
            waiting[size].index = nodes[node].first + i;
            waiting[size++].depth = depth + 1;
        }
    }
    return visited;
}

static void check_tree(void)
{
    if (count == 0) {
        TEST_ASSERT_EQUAL_UINT32_MESSAGE(0, tree.node_count,
                                         "nothing to hit: no nodes");
        return;
    }
    TEST_ASSERT_TRUE_MESSAGE(tree.node_count > 0 &&
                                 tree.node_count <= 2 * count - 1,
                             "between 1 and 2 n - 1 nodes");
    check_order();
    unsigned char *held = calloc(count, 1);
    unsigned char *parented = calloc(tree.node_count, 1);
    uint32_t visited = check_nodes(held, parented);
    TEST_ASSERT_EQUAL_UINT32_MESSAGE(tree.node_count, visited,
                                     "every node hangs below the root");
    for (uint32_t i = 0; i < count; i++)
        TEST_ASSERT_TRUE_MESSAGE(held[i], "a primitive is in no leaf");
    free(held);
    free(parented);
}

static void build_and_check(void)
{
    build();
    check_tree();
}

/* Building ----------------------------------------------------------------- */

static void nothing_gives_no_nodes(void)
{
    make_room(0);
    build_and_check();
}

static void one_primitive_gives_one_leaf(void)
{
    make_random(1, 1, 0.1f);
    build_and_check();
    TEST_ASSERT_EQUAL_UINT32(1, tree.node_count);
    TEST_ASSERT_EQUAL_UINT32(1, nodes[0].count);
}

static void few_primitives_give_a_tree(void)
{
    for (uint32_t n = 2; n < 40; n++) {
        make_random(n, 1, 0.1f);
        build_and_check();
    }
}

static void many_primitives_give_a_tree(void)
{
    make_random(1000, 1, 0.05f);
    build_and_check();
}

static void equal_boxes_give_a_tree(void)
{
    make_room(100000);
    for (uint32_t i = 0; i < count; i++)
        boxes[i] = box_around(vec3_make(1, 2, 3), 0.5f);
    build_and_check();
}

/* Boxes of different sizes about one point: there is nothing to sort by. */
static void equal_centroids_give_a_tree(void)
{
    make_room(50000);
    for (uint32_t i = 0; i < count; i++)
        boxes[i] = box_around(vec3_make(0, 0, 0), (float)(i + 1));
    build_and_check();
}

static void two_piles_of_equal_boxes_give_a_tree(void)
{
    make_room(50000);
    for (uint32_t i = 0; i < count; i++)
        boxes[i] = box_around(vec3_make(i % 3 ? 1.0f : -1.0f, 0, 0), 0.25f);
    build_and_check();
}

/* Boxes in a plane, on a line and without any extent. */
static void flat_boxes_give_a_tree(void)
{
    for (int flat = 0; flat < 3; flat++) {
        make_random(2000, 1, 0.1f);
        for (uint32_t i = 0; i < count; i++) {
            boxes[i].lower.y = boxes[i].upper.y = 0;
            if (flat > 0)
                boxes[i].lower.z = boxes[i].upper.z = 7;
            if (flat > 1)
                boxes[i].upper.x = boxes[i].lower.x;
        }
        build_and_check();
    }
}

/* Each box is a little larger and further away than all before it together;
 * a split that looks best cuts off one primitive at a time. */
static void sizes_from_1e_minus_6_to_1e6_give_a_tree(void)
{
    for (int random = 0; random < 2; random++) {
        make_room(5000);
        for (uint32_t i = 0; i < count; i++) {
            struct sampler s = sampler_start(SAMPLER_INDEPENDENT, 2, 0, i, 1);
            float part = random ? sampler_1d(&s) : (float)i / 5000.0f;
            float x = 1e-6f * powf(1e12f, part);
            boxes[i] = box_around(vec3_make(x, x, -x), 0.3f * x);
        }
        build_and_check();
    }
}

static void a_row_of_boxes_gives_a_tree(void)
{
    make_room(30000);
    for (uint32_t i = 0; i < count; i++)
        boxes[i] = box_around(vec3_make((float)i, 0, 0), 0.4f);
    build_and_check();
}

/* Far from the origin the centroids are few: float has no more of them. */
static void boxes_far_from_the_origin_give_a_tree(void)
{
    make_random(5000, 0.01f, 0.01f);
    for (uint32_t i = 0; i < count; i++) {
        vec3 far = vec3_make(1e5f, -1e5f, 1e5f);
        boxes[i].lower = vec3_add(boxes[i].lower, far);
        boxes[i].upper = vec3_add(boxes[i].upper, far);
    }
    build_and_check();
}

static void the_same_boxes_give_the_same_tree(void)
{
    make_random(1000, 1, 0.05f);
    build();
    struct bvh_node *first = malloc(tree.node_count * sizeof *first);
    uint32_t node_count = tree.node_count;
    memcpy(first, nodes, node_count * sizeof *first);
    build();
    TEST_ASSERT_EQUAL_UINT32(node_count, tree.node_count);
    TEST_ASSERT_EQUAL_INT_MESSAGE(
        0, memcmp(first, nodes, node_count * sizeof *first),
        "a tree must not depend on what the memory held before");
    free(first);
}

/* What a ray hits ---------------------------------------------------------- */

struct ball_hit {
    float t;
    uint32_t ball;
};

/* The ball in box i, in double: 0.999 of the box's half side. */
static bool hit_ball(uint32_t i, const ray *r, float *t)
{
    vec3 c = aabb_centroid(boxes[i]);
    double radius = 0.999 * 0.5 * (boxes[i].upper.x - boxes[i].lower.x);
    vec3 o = r->origin, d = r->direction;
    double x = (double)o.x - c.x, y = (double)o.y - c.y, z = (double)o.z - c.z;
    double a = (double)d.x * d.x + (double)d.y * d.y + (double)d.z * d.z;
    double b = x * d.x + y * d.y + z * d.z;
    double square = b * b - a * (x * x + y * y + z * z - radius * radius);
    if (!(square > 0.0))
        return false;
    double near = (-b - sqrt(square)) / a, far = (-b + sqrt(square)) / a;
    float first = (float)(near >= r->t_min ? near : far);
    if (!(first >= r->t_min && first <= r->t_max))
        return false;
    *t = first;
    return true;
}

static bool test_balls(const void *context, uint32_t first, uint32_t n, ray *r,
                       void *out)
{
    struct ball_hit *hit = out;
    bool found = false;
    TEST_ASSERT_TRUE_MESSAGE(context == &tree, "context is handed on as it is");
    TEST_ASSERT_TRUE_MESSAGE(n > 0 && first < count && n <= count - first,
                             "test() is called with the range of a leaf");
    leaves_tested++;
    balls_tested += n;
    for (uint32_t i = first; i < first + n; i++) {
        if (!hit_ball(permutation[i], r, &hit->t))
            continue;
        hit->ball = permutation[i];
        r->t_max = hit->t;
        found = true;
    }
    return found;
}

static struct ball_hit brute_force(ray r)
{
    struct ball_hit hit = {-1.0f, UINT32_MAX};
    for (uint32_t i = 0; i < count; i++)
        if (hit_ball(i, &r, &hit.t)) {
            hit.ball = i;
            r.t_max = hit.t;
        }
    return hit;
}

static void check_nearest(ray r)
{
    struct ball_hit want = brute_force(r), got = {-1.0f, UINT32_MAX};
    bool found = bvh_nearest(&tree, &r, test_balls, &tree, &got);
    TEST_ASSERT_EQUAL_INT_MESSAGE(want.ball != UINT32_MAX, found,
                                  "bvh_nearest: is anything hit at all?");
    TEST_ASSERT_TRUE_MESSAGE(want.t == got.t,
                             "bvh_nearest: the nearest hit, not some hit");
}

static void check_any(ray r)
{
    struct ball_hit want = brute_force(r), got = {-1.0f, UINT32_MAX};
    bool found = bvh_any(&tree, &r, test_balls, &tree, &got);
    TEST_ASSERT_EQUAL_INT_MESSAGE(want.ball != UINT32_MAX, found,
                                  "bvh_any: is anything hit at all?");
}

/* From in or around the set, towards it; some have a range that ends soon. */
static ray random_ray(uint64_t i, float size)
{
    struct sampler s = sampler_start(SAMPLER_INDEPENDENT, 3, 0, i, 1);
    vec3 from = random_point(&s, 2 * size);
    vec3 d = vec3_sub(random_point(&s, size), from);
    float t_max = sampler_1d(&s) < 0.3f ? sampler_1d(&s) : INFINITY;
    if (i % 5 == 0)
        d = vec3_make(0, d.y, -0.0f);
    return ray_make(from, d, 0.0f, t_max);
}

static void check_rays(uint64_t n, float size)
{
    build();
    for (uint64_t i = 0; i < n; i++) {
        check_nearest(random_ray(i, size));
        check_any(random_ray(i, size));
    }
}

static void an_empty_tree_is_missed(void)
{
    make_room(0);
    check_rays(10, 1);
}

static void one_ball_is_found(void)
{
    make_random(1, 0.1f, 0.5f);
    check_rays(200, 1);
}

static void two_balls_are_found(void)
{
    make_random(2, 0.5f, 0.5f);
    check_rays(500, 1);
}

static void a_thousand_balls_are_found(void)
{
    make_random(1000, 1, 0.08f);
    check_rays(3000, 1);
}

static void balls_that_overlap_are_found(void)
{
    make_random(300, 0.3f, 1.0f);
    check_rays(2000, 1);
}

static void equal_balls_are_found(void)
{
    make_room(500);
    for (uint32_t i = 0; i < count; i++)
        boxes[i] = box_around(vec3_make(0.25f, 0, 0), 0.5f);
    check_rays(300, 1);
}

static void balls_of_all_sizes_are_found(void)
{
    make_room(500);
    for (uint32_t i = 0; i < count; i++) {
        struct sampler s = sampler_start(SAMPLER_INDEPENDENT, 4, 0, i, 1);
        float size = 1e-6f * powf(1e12f, sampler_1d(&s));
        boxes[i] = box_around(random_point(&s, 2 * size), size);
    }
    build();
    for (uint64_t i = 0; i < 3000; i++) {
        float size = 1e-6f * powf(1e12f, (float)i / 3000.0f);
        check_nearest(random_ray(i, size));
        check_any(random_ray(i, size));
    }
}

static void t_min_and_t_max_are_kept(void)
{
    make_random(500, 1, 0.1f);
    build();
    for (uint64_t i = 0; i < 2000; i++) {
        struct sampler s = sampler_start(SAMPLER_INDEPENDENT, 5, 0, i, 1);
        ray r = random_ray(i, 1);
        r.t_min = sampler_1d(&s);
        r.t_max = r.t_min + 0.3f * sampler_1d(&s);
        check_nearest(r);
        check_any(r);
    }
}

/* Trees that a builder of ours did not make -------------------------------- */

/* Ball i sits at x = 2 i; the deepest tree there may be: each node has a leaf
 * of one ball and the rest. leaf_first: the leaf is the first child. */
static void make_deepest_tree(bool leaf_first)
{
    make_room(BVH_MAX_DEPTH);
    for (uint32_t i = 0; i < count; i++) {
        boxes[i] = box_around(vec3_make(2.0f * (float)i, 0, 0), 0.5f);
        permutation[i] = i;
    }
    aabb all = aabb_union(boxes[0], boxes[count - 1]);
    uint32_t node = 0, next = 1;
    for (uint32_t i = 0; i + 1 < count; i++) {
        uint32_t leaf = leaf_first ? next : next + 1;
        nodes[node] = (struct bvh_node){all, next, 0};
        nodes[leaf] = (struct bvh_node){boxes[i], i, 1};
        node = leaf_first ? next + 1 : next;
        next += 2;
    }
    nodes[node] = (struct bvh_node){boxes[count - 1], count - 1, 1};
    tree.nodes = nodes;
    tree.node_count = next;
}

static void the_deepest_tree_is_walked(void)
{
    for (int i = 0; i < 4; i++) {
        make_deepest_tree(i % 2);
        float side = i < 2 ? -1.0f : 1.0f;
        vec3 from = vec3_make(63 + 200 * side, 0.1f, 0.1f);
        vec3 d = vec3_make(-side, 0, 0);
        check_nearest(ray_make(from, d, 0, INFINITY));
        check_any(ray_make(from, d, 0, INFINITY));
        for (uint32_t ball = 0; ball < count; ball++) {
            vec3 above = vec3_make(2.0f * (float)ball, 5, 0.1f);
            ray down = ray_make(above, vec3_make(0.001f, -1, 0), 0, INFINITY);
            check_nearest(down);
            check_any(down);
        }
    }
}

static void a_single_leaf_of_many_is_walked(void)
{
    make_random(BVH_MAX_LEAF, 1, 0.3f);
    nodes[0] = (struct bvh_node){box_around(vec3_make(0, 0, 0), 2), 0, count};
    for (uint32_t i = 0; i < count; i++)
        permutation[i] = count - 1 - i;
    tree.nodes = nodes;
    tree.node_count = 1;
    for (uint64_t i = 0; i < 300; i++) {
        check_nearest(random_ray(i, 1));
        check_any(random_ray(i, 1));
    }
}

/* Work --------------------------------------------------------------------- */

static void start_counting(void)
{
    leaves_tested = balls_tested = 0;
    counters_mine.boxes_tested = 0;
}

/* Balls and boxes that the n rays had to be tested with, on average. */
static double work_of_rays(uint64_t n, float size)
{
    struct ball_hit hit;
    start_counting();
    for (uint64_t i = 0; i < n; i++) {
        ray r = random_ray(i, size);
        bvh_nearest(&tree, &r, test_balls, &tree, &hit);
    }
    return (double)(balls_tested + counters_mine.boxes_tested) / (double)n;
}

/* No tree saves work while every box counts as hit. */
static void wait_for_boxes(void)
{
    const aabb box = {{0, 0, 0}, {1, 1, 1}};
    ray past = ray_make(vec3_make(5, 5, 5), vec3_make(1, 0, 0), 0, INFINITY);
    float enter, leave;
    if (aabb_intersect(&box, &past, &enter, &leave))
        TEST_IGNORE_MESSAGE("waits for assignment 02: no box is ever missed");
}

static void the_tree_saves_work(void)
{
    wait_for_boxes();
    make_random(20000, 1, 0.02f);
    build();
    TEST_ASSERT_TRUE_MESSAGE(work_of_rays(500, 1) < 2000,
                             "of 20000 balls, a ray is tested with a tenth at "
                             "most, boxes counted too");
}

/* Ten times as many balls are a little more work: it grows with log n. */
static void many_boxes_give_a_tree_that_saves_work(void)
{
    wait_for_boxes();
    make_random(200000, 1, 0.0045f);
    build_and_check();
    TEST_ASSERT_TRUE_MESSAGE(work_of_rays(100, 1) < 4000,
                             "of 200000 balls, a ray is tested with a "
                             "fiftieth at most, boxes counted too");
}

static void what_misses_the_root_costs_nothing(void)
{
    struct ball_hit hit;
    wait_for_boxes();
    make_random(1000, 1, 0.02f);
    build();
    start_counting();
    for (int i = 0; i < 100; i++) {
        ray r = ray_make(vec3_make(5, (float)i, 0), vec3_make(1, 1, 1), 0,
                         INFINITY);
        TEST_ASSERT_FALSE(bvh_nearest(&tree, &r, test_balls, &tree, &hit));
        r = ray_make(vec3_make(5, (float)i, 0), vec3_make(1, 1, 1), 0,
                     INFINITY);
        TEST_ASSERT_FALSE(bvh_any(&tree, &r, test_balls, &tree, &hit));
    }
    TEST_ASSERT_EQUAL_INT_MESSAGE(0, (int)balls_tested,
                                  "rays that miss the root's box");
}

/* A row of balls, seen from one end: all of their boxes are on the ray. */
static uint64_t work_along_the_row(float side)
{
    struct ball_hit hit;
    ray r = ray_make(vec3_make(2000 * side, 0, 0), vec3_make(-side, 0, 0), 0,
                     INFINITY);
    start_counting();
    TEST_ASSERT_TRUE(bvh_nearest(&tree, &r, test_balls, &tree, &hit));
    return balls_tested;
}

static void what_lies_behind_a_hit_is_skipped(void)
{
    wait_for_boxes();
    make_room(1000);
    for (uint32_t i = 0; i < count; i++)
        boxes[i] = box_around(vec3_make((float)i - 500, 0, 0), 0.4f);
    build();
    uint64_t left = work_along_the_row(-1), right = work_along_the_row(1);
    TEST_ASSERT_TRUE_MESSAGE((left < right ? left : right) < 200,
                             "the hit lowers r->t_max: leaves that begin "
                             "beyond it need no test");
}

/* Most rays start among balls that overlap: one leaf or two will do. */
static void any_stops_at_the_first_hit(void)
{
    struct ball_hit hit;
    make_random(1000, 0.5f, 0.5f);
    build();
    start_counting();
    for (uint64_t i = 0; i < 500; i++) {
        ray r = random_ray(i, 0.1f);
        bvh_any(&tree, &r, test_balls, &tree, &hit);
    }
    uint64_t any = leaves_tested;
    for (uint64_t i = 0; i < 500; i++) {
        ray r = random_ray(i, 0.1f);
        bvh_nearest(&tree, &r, test_balls, &tree, &hit);
    }
    TEST_ASSERT_TRUE_MESSAGE(2 * any < leaves_tested - any,
                             "bvh_any returns as soon as a test is true");
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(nothing_gives_no_nodes);
    RUN_TEST(one_primitive_gives_one_leaf);
    RUN_TEST(few_primitives_give_a_tree);
    RUN_TEST(many_primitives_give_a_tree);
    RUN_TEST(equal_boxes_give_a_tree);
    RUN_TEST(equal_centroids_give_a_tree);
    RUN_TEST(two_piles_of_equal_boxes_give_a_tree);
    RUN_TEST(flat_boxes_give_a_tree);
    RUN_TEST(sizes_from_1e_minus_6_to_1e6_give_a_tree);
    RUN_TEST(a_row_of_boxes_gives_a_tree);
    RUN_TEST(boxes_far_from_the_origin_give_a_tree);
    RUN_TEST(the_same_boxes_give_the_same_tree);
    RUN_TEST(an_empty_tree_is_missed);
    RUN_TEST(one_ball_is_found);
    RUN_TEST(two_balls_are_found);
    RUN_TEST(a_thousand_balls_are_found);
    RUN_TEST(balls_that_overlap_are_found);
    RUN_TEST(equal_balls_are_found);
    RUN_TEST(balls_of_all_sizes_are_found);
    RUN_TEST(t_min_and_t_max_are_kept);
    RUN_TEST(the_deepest_tree_is_walked);
    RUN_TEST(a_single_leaf_of_many_is_walked);
    RUN_TEST(the_tree_saves_work);
    RUN_TEST(many_boxes_give_a_tree_that_saves_work);
    RUN_TEST(what_misses_the_root_costs_nothing);
    RUN_TEST(what_lies_behind_a_hit_is_skipped);
    RUN_TEST(any_stops_at_the_first_hit);
    return UNITY_END();
}
