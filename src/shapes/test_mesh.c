/* test_mesh.c - tests of mesh.h. */
#include "shapes/mesh.h"

#include "unity.h"

/* A quad in the plane z = 0, from (0, 0) to (4, 2), of two triangles. */
static vec3 positions[4];
static vec3 normals[4];
static vec2 uvs[4];
static uint32_t indices[6];
static struct mesh quad;

void setUp(void)
{
    static const vec3 corners[4] = {{0, 0, 0}, {4, 0, 0}, {4, 2, 0}, {0, 2, 0}};
    static const uint32_t fan[6] = {0, 1, 2, 0, 2, 3};
    for (int i = 0; i < 4; i++) {
        positions[i] = corners[i];
        normals[i] = vec3_make(0, 0, 1);
        uvs[i] = vec2_make(corners[i].x / 4, corners[i].y / 2);
    }
    for (int i = 0; i < 6; i++)
        indices[i] = fan[i];
    quad = (struct mesh){positions, NULL, NULL, indices, 4, 2};
}

void tearDown(void)
{
}

static void expect_vec3(vec3 want, vec3 got, const char *what)
{
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(1e-5f, want.x, got.x, what);
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(1e-5f, want.y, got.y, what);
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(1e-5f, want.z, got.z, what);
}

static struct surface surface_at(uint32_t triangle, float b1, float b2)
{
    struct triangle_hit hit = {1.0f, b1, b2};
    struct surface s;
    mesh_surface(&quad, triangle, &hit, &s);
    return s;
}

static void corners_come_by_index(void)
{
    vec3 p[3];
    mesh_corners(&quad, 1, p);
    expect_vec3(vec3_make(0, 0, 0), p[0], "p0");
    expect_vec3(vec3_make(4, 2, 0), p[1], "p1");
    expect_vec3(vec3_make(0, 2, 0), p[2], "p2");
}

static void positions_are_weighted_corners(void)
{
    expect_vec3(vec3_make(3, 1, 0), surface_at(0, 0.25f, 0.5f).position,
                "0.25 p0 + 0.25 p1 + 0.5 p2");
    expect_vec3(vec3_make(2, 1.5f, 0), surface_at(1, 0.5f, 0.25f).position,
                "0.25 p0 + 0.5 p1 + 0.25 p2");
}

/* The true point is within the stated error of the computed one. */
static void the_position_error_is_a_bound(void)
{
    positions[0] = vec3_make(-77.7f, 31.4f, 0.1f);
    positions[1] = vec3_make(4.1f, -0.3f, 1.7f);
    positions[2] = vec3_make(1001.3f, 2.2f, -0.9f);
    for (int i = 0; i < 1000; i++) {
        float b1 = (float)i / 1517.0f, b2 = (float)(997 - i) / 1733.0f;
        b2 = fmaxf(0, fminf(b2, 1 - b1));
        struct surface s = surface_at(0, b1, b2);
        const vec3 *p = positions;
        double w1 = b1, w2 = b2, w0 = 1.0 - w1 - w2;
        double x = w0 * p[0].x + w1 * p[1].x + w2 * p[2].x;
        double y = w0 * p[0].y + w1 * p[1].y + w2 * p[2].y;
        TEST_ASSERT_TRUE(fabs(s.position.x - x) <= s.position_error.x);
        TEST_ASSERT_TRUE(fabs(s.position.y - y) <= s.position_error.y);
        TEST_ASSERT_TRUE(s.position_error.x < 2e-6f * 1001);
    }
}

static void the_geometric_normal_follows_the_winding(void)
{
    expect_vec3(vec3_make(0, 0, 1), surface_at(0, 0.2f, 0.2f).geometric_normal,
                "counter-clockwise seen from +z");
    indices[1] = 2;
    indices[2] = 1;
    expect_vec3(vec3_make(0, 0, -1), surface_at(0, 0.2f, 0.2f).geometric_normal,
                "turned round");
}

static void without_vertex_normals_the_mesh_is_flat(void)
{
    struct surface s = surface_at(0, 0.2f, 0.2f);
    expect_vec3(s.geometric_normal, s.shading_normal, "shading normal");
}

static void vertex_normals_are_interpolated(void)
{
    quad.normals = normals;
    normals[1] = vec3_make(0.6f, 0, 0.8f);
    vec3 n = surface_at(0, 0.5f, 0.0f).shading_normal;
    expect_vec3(vec3_normalize(vec3_make(0.3f, 0, 0.9f)), n, "half way");
    expect_vec3(normals[1], surface_at(0, 1, 0).shading_normal, "at p1");
}

static void vertex_normals_turn_to_the_geometric_side(void)
{
    quad.normals = normals;
    for (int i = 0; i < 4; i++)
        normals[i] = vec3_make(0.6f, 0, -0.8f);
    expect_vec3(vec3_make(-0.6f, 0, 0.8f),
                surface_at(0, 0.2f, 0.2f).shading_normal, "turned");
}

static void normals_that_cancel_give_the_geometric_one(void)
{
    quad.normals = normals;
    normals[0] = vec3_make(1, 0, 0);
    normals[1] = vec3_make(-1, 0, 0);
    expect_vec3(vec3_make(0, 0, 1), surface_at(0, 0.5f, 0).shading_normal,
                "they cancel half way");
    normals[0] = normals[1] = normals[2] = vec3_make(0, 0, 0);
    expect_vec3(vec3_make(0, 0, 1), surface_at(0, 0.3f, 0.3f).shading_normal,
                "all are zero");
}

static void texture_coordinates_are_interpolated(void)
{
    quad.uvs = uvs;
    struct surface s = surface_at(0, 0.25f, 0.5f); /* at (3, 1) */
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.75f, s.uv.x);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.5f, s.uv.y);
    expect_vec3(vec3_make(4, 0, 0), s.dp_du, "dp_du");
    expect_vec3(vec3_make(0, 2, 0), s.dp_dv, "dp_dv");
}

static void without_texture_coordinates_uv_is_barycentric(void)
{
    struct surface s = surface_at(0, 0.25f, 0.5f);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.25f, s.uv.x);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.5f, s.uv.y);
    expect_vec3(vec3_make(4, 0, 0), s.dp_du, "dp_du = p1 - p0");
    expect_vec3(vec3_make(4, 2, 0), s.dp_dv, "dp_dv = p2 - p0");
}

static void equal_texture_coordinates_give_some_frame(void)
{
    quad.uvs = uvs;
    uvs[0] = uvs[1] = uvs[2] = vec2_make(0.5f, 0.5f);
    struct surface s = surface_at(0, 0.25f, 0.5f);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0, vec3_dot(s.dp_du, s.geometric_normal));
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0, vec3_dot(s.dp_dv, s.geometric_normal));
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 1,
                             vec3_length(vec3_cross(s.dp_du, s.dp_dv)));
}

static struct transform scaled(float x, float y, float z)
{
    const float rows[16] = {x, 0, 0, 1, 0, y, 0, 2, 0, 0, z, 3, 0, 0, 0, 1};
    struct transform t;
    TEST_ASSERT_TRUE(transform_from_rows(rows, &t));
    return t;
}

static void a_transform_moves_every_vertex(void)
{
    struct transform t = scaled(2, 3, 4);
    mesh_transform(&quad, &t);
    expect_vec3(vec3_make(1, 2, 3), positions[0], "p0");
    expect_vec3(vec3_make(9, 8, 3), positions[2], "p2");
}

static void a_transform_keeps_normals_at_right_angles(void)
{
    quad.normals = normals;
    vec3 slanted = vec3_normalize(vec3_make(1, 0, 1));
    normals[0] = slanted;
    struct transform t = scaled(2, 1, 1);
    mesh_transform(&quad, &t);
    expect_vec3(vec3_normalize(vec3_make(0.5f, 0, 1)), normals[0],
                "the normal of a slope that is stretched along x");
}

static void a_zero_normal_stays_zero(void)
{
    quad.normals = normals;
    normals[3] = vec3_make(0, 0, 0);
    struct transform t = scaled(2, 3, 4);
    mesh_transform(&quad, &t);
    expect_vec3(vec3_make(0, 0, 0), normals[3], "no NaN");
}

static void a_mirror_keeps_the_outside_outside(void)
{
    quad.normals = normals;
    struct transform t = scaled(-1, 1, 1);
    mesh_transform(&quad, &t);
    for (uint32_t i = 0; i < 2; i++) {
        struct surface s = surface_at(i, 0.2f, 0.2f);
        expect_vec3(vec3_make(0, 0, 1), s.geometric_normal, "geometric");
        expect_vec3(vec3_make(0, 0, 1), s.shading_normal, "shading");
    }
}

static void an_empty_mesh_is_fine(void)
{
    struct mesh none = {NULL, NULL, NULL, NULL, 0, 0};
    struct transform t = scaled(-1, 1, 1);
    mesh_transform(&none, &t);
    mesh_free(&none);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(corners_come_by_index);
    RUN_TEST(positions_are_weighted_corners);
    RUN_TEST(the_position_error_is_a_bound);
    RUN_TEST(the_geometric_normal_follows_the_winding);
    RUN_TEST(without_vertex_normals_the_mesh_is_flat);
    RUN_TEST(vertex_normals_are_interpolated);
    RUN_TEST(vertex_normals_turn_to_the_geometric_side);
    RUN_TEST(normals_that_cancel_give_the_geometric_one);
    RUN_TEST(texture_coordinates_are_interpolated);
    RUN_TEST(without_texture_coordinates_uv_is_barycentric);
    RUN_TEST(equal_texture_coordinates_give_some_frame);
    RUN_TEST(a_transform_moves_every_vertex);
    RUN_TEST(a_transform_keeps_normals_at_right_angles);
    RUN_TEST(a_zero_normal_stays_zero);
    RUN_TEST(a_mirror_keeps_the_outside_outside);
    RUN_TEST(an_empty_mesh_is_fine);
    return UNITY_END();
}
