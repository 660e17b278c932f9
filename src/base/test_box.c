/* test_box.c - tests of box.h: union, area, centroid and the empty box. */
#include "base/box.h"

#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static aabb box_of(float x0, float y0, float z0, float x1, float y1, float z1)
{
    aabb box = {vec3_make(x0, y0, z0), vec3_make(x1, y1, z1)};
    return box;
}

static void expect_box(aabb want, aabb got)
{
    TEST_ASSERT_EQUAL_FLOAT(want.lower.x, got.lower.x);
    TEST_ASSERT_EQUAL_FLOAT(want.lower.y, got.lower.y);
    TEST_ASSERT_EQUAL_FLOAT(want.lower.z, got.lower.z);
    TEST_ASSERT_EQUAL_FLOAT(want.upper.x, got.upper.x);
    TEST_ASSERT_EQUAL_FLOAT(want.upper.y, got.upper.y);
    TEST_ASSERT_EQUAL_FLOAT(want.upper.z, got.upper.z);
}

static void a_union_holds_both(void)
{
    aabb a = box_of(0, 0, 0, 1, 1, 1), b = box_of(-2, 0.5f, 3, -1, 0.75f, 4);
    aabb both = box_of(-2, 0, 0, 1, 1, 4);
    expect_box(both, aabb_union(a, b));
    expect_box(both, aabb_union(b, a));
    expect_box(a, aabb_union(a, a));
}

static void the_empty_box_is_neutral(void)
{
    aabb a = box_of(-1, 2, 3, 4, 5, 6);
    expect_box(a, aabb_union(a, aabb_empty()));
    expect_box(a, aabb_union(aabb_empty(), a));
}

static void a_first_point_makes_a_point(void)
{
    aabb point = aabb_include(aabb_empty(), vec3_make(1, -2, 3));
    expect_box(box_of(1, -2, 3, 1, -2, 3), point);
    TEST_ASSERT_EQUAL_FLOAT(0, aabb_area(point));
}

static void a_point_inside_changes_nothing(void)
{
    aabb a = box_of(0, 0, 0, 1, 1, 1);
    expect_box(a, aabb_include(a, vec3_make(0.5f, 1, 0)));
    expect_box(box_of(0, -1, 0, 1, 1, 1),
               aabb_include(a, vec3_make(0.5f, -1, 0)));
}

static void areas_count_all_six_faces(void)
{
    TEST_ASSERT_EQUAL_FLOAT(6, aabb_area(box_of(0, 0, 0, 1, 1, 1)));
    TEST_ASSERT_EQUAL_FLOAT(52, aabb_area(box_of(1, 1, 1, 3, 4, 5)));
    TEST_ASSERT_EQUAL_FLOAT(0, aabb_area(aabb_empty()));
}

/* A rectangle has two sides; a segment has none. */
static void flat_boxes_have_the_area_of_their_faces(void)
{
    TEST_ASSERT_EQUAL_FLOAT(12, aabb_area(box_of(0, 7, 0, 2, 7, 3)));
    TEST_ASSERT_EQUAL_FLOAT(0, aabb_area(box_of(0, 7, 0, 2, 7, 0)));
}

static void a_centroid_is_the_middle(void)
{
    vec3 c = aabb_centroid(box_of(-1, 0, 10, 3, 0, 20));
    TEST_ASSERT_EQUAL_FLOAT(1, c.x);
    TEST_ASSERT_EQUAL_FLOAT(0, c.y);
    TEST_ASSERT_EQUAL_FLOAT(15, c.z);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(a_union_holds_both);
    RUN_TEST(the_empty_box_is_neutral);
    RUN_TEST(a_first_point_makes_a_point);
    RUN_TEST(a_point_inside_changes_nothing);
    RUN_TEST(areas_count_all_six_faces);
    RUN_TEST(flat_boxes_have_the_area_of_their_faces);
    RUN_TEST(a_centroid_is_the_middle);
    return UNITY_END();
}
