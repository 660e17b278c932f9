/* test_accel.c - the acceleration structures give one answer.
 *
 * The primitives are their own boxes: a ray hits one where it enters it. */
#include "accel/accel.h"

#include <stdio.h>

#include "accel/aabb.h"
#include "base/memory.h"
#include "sampling/random.h"
#include "unity.h"

enum { KINDS = 4, COUNT = 500, RAYS = 2000 };

void setUp(void)
{
}

void tearDown(void)
{
}

/* What leaves test: the boxes in the structure's order. */
struct boxes {
    const aabb *boxes;
    const uint32_t *order;
    int calls;
};

struct found {
    uint32_t box;
    float t;
};

static bool test_boxes(const void *context, uint32_t first, uint32_t count,
                       ray *r, void *hit)
{
    struct boxes *b = (struct boxes *)context;
    struct found *out = hit;
    bool found = false;
    b->calls++;
    for (uint32_t i = first; i < first + count; i++) {
        float enter, leave;
        if (!aabb_intersect(&b->boxes[b->order[i]], r, &enter, &leave))
            continue;
        if (enter == r->t_max && found)
            continue;
        out->box = b->order[i];
        out->t = r->t_max = enter;
        found = true;
    }
    return found;
}

static vec3 random_vec(uint64_t key, uint32_t first)
{
    return vec3_make(random_float(key, first) - 0.5f,
                     random_float(key, first + 1) - 0.5f,
                     random_float(key, first + 2) - 0.5f);
}

static void fill(aabb boxes[COUNT])
{
    for (uint32_t i = 0; i < COUNT; i++) {
        uint64_t key = random_key(5, i, 0);
        vec3 at = vec3_scale(random_vec(key, 0), 10.0f);
        vec3 half = vec3_scale(vec3_abs(random_vec(key, 3)), 0.5f);
        boxes[i].lower = vec3_sub(at, half);
        boxes[i].upper = vec3_add(at, half);
    }
}

static ray random_ray(uint32_t i)
{
    uint64_t key = random_key(6, i, 0);
    return ray_make(vec3_scale(random_vec(key, 0), 12.0f), random_vec(key, 3),
                    0.0f, i % 3 == 0 ? 5.0f : INFINITY);
}

static bool ask(const struct accel *a, struct boxes *b, ray r, bool any,
                struct found *out)
{
    *out = (struct found){UINT32_MAX, -1.0f};
    return any ? accel_any(a, &r, test_boxes, b, out)
               : accel_nearest(a, &r, test_boxes, b, out);
}

static void every_kind_has_a_name(void)
{
    TEST_ASSERT_EQUAL_STRING("wide", accel_names[ACCEL_WIDE]);
    TEST_ASSERT_EQUAL_STRING("bvh", accel_names[ACCEL_BVH]);
    TEST_ASSERT_EQUAL_STRING("linear", accel_names[ACCEL_LINEAR]);
    TEST_ASSERT_EQUAL_STRING("embree", accel_names[ACCEL_EMBREE]);
    TEST_ASSERT_NULL(accel_names[KINDS]);
    TEST_ASSERT_TRUE(accel_available(ACCEL_WIDE));
    TEST_ASSERT_TRUE(accel_available(ACCEL_BVH));
    TEST_ASSERT_TRUE(accel_available(ACCEL_LINEAR));
#ifdef RAYBOOK_EMBREE
    TEST_ASSERT_TRUE(accel_available(ACCEL_EMBREE));
#else
    TEST_ASSERT_FALSE(accel_available(ACCEL_EMBREE));
#endif
}

static void nothing_is_hit_in_nothing(void)
{
    for (int kind = 0; kind < KINDS; kind++) {
        struct found out;
        if (!accel_available((enum accel_kind)kind))
            continue;
        struct accel a = accel_build((enum accel_kind)kind, NULL, 0, NULL);
        struct boxes b = {NULL, NULL, 0};
        for (uint32_t i = 0; i < 10; i++) {
            TEST_ASSERT_FALSE(ask(&a, &b, random_ray(i), false, &out));
            TEST_ASSERT_FALSE(ask(&a, &b, random_ray(i), true, &out));
        }
        TEST_ASSERT_EQUAL_INT(0, b.calls);
        accel_free(&a);
    }
}

static void order_is_a_permutation(void)
{
    static aabb boxes[COUNT];
    fill(boxes);
    for (int kind = 0; kind < KINDS; kind++) {
        uint32_t order[COUNT];
        bool seen[COUNT] = {false};
        if (!accel_available((enum accel_kind)kind))
            continue;
        struct accel a =
            accel_build((enum accel_kind)kind, boxes, COUNT, order);
        for (uint32_t i = 0; i < COUNT; i++) {
            TEST_ASSERT_TRUE(order[i] < COUNT && !seen[order[i]]);
            seen[order[i]] = true;
        }
        accel_free(&a);
    }
}

/* A ray that starts inside several boxes hits all of them at t = 0; whichever
 * is found, t is the same. */
static void all_kinds_find_the_same(void)
{
    static aabb boxes[COUNT];
    uint32_t order[KINDS][COUNT];
    struct accel a[KINDS];
    int hits = 0;
    fill(boxes);
    for (int kind = 0; kind < KINDS; kind++)
        if (accel_available((enum accel_kind)kind))
            a[kind] =
                accel_build((enum accel_kind)kind, boxes, COUNT, order[kind]);
    for (uint32_t i = 0; i < RAYS; i++) {
        struct boxes all = {boxes, order[ACCEL_LINEAR], 0};
        struct found want, got;
        ray r = random_ray(i);
        bool hit = ask(&a[ACCEL_LINEAR], &all, r, false, &want);
        hits += hit;
        for (int kind = 0; kind < KINDS; kind++) {
            struct boxes b = {boxes, order[kind], 0};
            if (!accel_available((enum accel_kind)kind))
                continue;
            TEST_ASSERT_EQUAL(hit, ask(&a[kind], &b, r, false, &got));
            TEST_ASSERT_EQUAL_FLOAT(want.t, got.t);
            TEST_ASSERT_EQUAL(hit, ask(&a[kind], &b, r, true, &got));
        }
    }
    TEST_ASSERT_TRUE(hits > RAYS / 10 && hits < RAYS * 9 / 10);
    for (int kind = 0; kind < KINDS; kind++)
        if (accel_available((enum accel_kind)kind))
            accel_free(&a[kind]);
}

/* Any hit will do: far from all boxes need be asked about. */
static void trees_ask_about_little(void)
{
    static aabb boxes[COUNT];
    uint32_t order[COUNT];
    fill(boxes);
    for (int kind = 0; kind < KINDS; kind++) {
        struct boxes b = {boxes, order, 0};
        struct found out;
        if (kind == ACCEL_LINEAR || !accel_available((enum accel_kind)kind))
            continue;
        struct accel a =
            accel_build((enum accel_kind)kind, boxes, COUNT, order);
        for (uint32_t i = 0; i < RAYS; i++)
            ask(&a, &b, random_ray(i), false, &out);
        TEST_ASSERT_LESS_THAN_MESSAGE(RAYS * COUNT / 20, b.calls,
                                      accel_names[kind]);
        accel_free(&a);
    }
}

static void freeing_twice_is_harmless(void)
{
    static aabb boxes[COUNT];
    uint32_t order[COUNT];
    fill(boxes);
    for (int kind = 0; kind < KINDS; kind++) {
        if (!accel_available((enum accel_kind)kind))
            continue;
        struct accel a =
            accel_build((enum accel_kind)kind, boxes, COUNT, order);
        accel_free(&a);
        accel_free(&a);
        TEST_ASSERT_NULL(a.nodes);
        TEST_ASSERT_NULL(a.wide.memory);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(every_kind_has_a_name);
    RUN_TEST(nothing_is_hit_in_nothing);
    RUN_TEST(order_is_a_permutation);
    RUN_TEST(all_kinds_find_the_same);
    RUN_TEST(trees_ask_about_little);
    RUN_TEST(freeing_twice_is_harmless);
    return UNITY_END();
}
