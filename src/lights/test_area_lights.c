/* test_area_lights.c - rectangles, spheres and meshes that shine. */
#include "lights/light.h"

#include <string.h>

#include "base/constants.h"
#include "base/memory.h"
#include "lights/mesh_light.h"
#include "lights/rect_light.h"
#include "lights/sphere_light.h"
#include "sampling/test_density.h"
#include "sampling/warp.h"
#include "shapes/triangle.h"
#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

/* ---- lights to test with ---- */

static struct rect make_rect(const float rows[12])
{
    float all[16] = {0};
    struct transform t;
    memcpy(all, rows, 12 * sizeof *rows);
    all[15] = 1.0f;
    TEST_ASSERT_TRUE(transform_from_rows(all, &t));
    return rect_make(&t);
}

/* Two by one metre, at height 2, shining down. */
static struct rect lamp(void)
{
    static const float rows[12] = {2, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 2};
    return make_rect(rows);
}

/* No right angle, no axis. */
static struct rect skewed(void)
{
    static const float rows[12] = {1.0f, 0.5f, 0.2f, 0.3f, 0.1f, 0.8f,
                                   0.4f, 1.0f, -.3f, -.2f, -.9f, 0.5f};
    return make_rect(rows);
}

static struct light with_radiance(enum light_kind kind)
{
    struct light light = {.kind = kind, .radiance = {3.0f, 2.0f, 1.0f}};
    return light;
}

static struct light rect_light(const struct rect *rect)
{
    struct light light = with_radiance(LIGHT_RECT);
    light_set_rect(&light, rect);
    return light;
}

static struct light sphere_light(const struct sphere *sphere)
{
    struct light light = with_radiance(LIGHT_SPHERE);
    light_set_sphere(&light, sphere);
    return light;
}

static struct light mesh_light(const struct mesh *mesh)
{
    struct light light = with_radiance(LIGHT_MESH);
    light_set_mesh(&light, mesh);
    return light;
}

/* An octahedron that is stretched along each axis, normals outwards. */
static vec3 octahedron_corners[6] = {{1.0f, 0.0f, 0.0f},  {-1.0f, 0.0f, 0.0f},
                                     {0.0f, 0.5f, 0.0f},  {0.0f, -0.5f, 0.0f},
                                     {0.0f, 0.0f, 0.25f}, {0.0f, 0.0f, -2.0f}};
static uint32_t octahedron_indices[24] = {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4,
                                          2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};
static const struct mesh octahedron = {octahedron_corners, NULL, NULL,
                                       octahedron_indices, 6,    8};

/* Three unequal triangles that open upwards, and one without area. */
static vec3 dish_corners[4] = {{0.0f, 0.0f, 0.0f},
                               {1.0f, 0.0f, 0.2f},
                               {-0.4f, 1.5f, 0.3f},
                               {-0.3f, -0.2f, 0.1f}};
static uint32_t dish_indices[12] = {0, 1, 2, 0, 2, 3, 0, 0, 1, 0, 3, 1};
static const struct mesh dish = {dish_corners, NULL, NULL, dish_indices, 4, 4};

/* ---- the density of a light, found by looking ---- */

struct view {
    const struct light *light;
    vec3 point;
};

static double mesh_density(const struct view *view, const ray *r)
{
    const struct mesh *m = view->light->mesh;
    double sum = 0.0;
    for (uint32_t i = 0; i < m->triangle_count; i++) {
        vec3 p[3];
        struct triangle_hit hit;
        mesh_corners(m, i, p);
        if (!triangle_intersect(p, r, &hit))
            continue;
        struct surface s;
        mesh_surface(m, i, &hit, &s);
        sum += light_pdf(view->light, view->point, r->direction, s.position,
                         s.geometric_normal);
    }
    return sum;
}

/* A mesh may be met several times: each hit could have been picked. */
static double seen_density(const void *context, vec3 direction)
{
    const struct view *view = context;
    const struct light *light = view->light;
    ray r = ray_make(view->point, direction, 0.0f, INFINITY);
    struct surface s;
    float t;
    if (light->kind == LIGHT_MESH)
        return mesh_density(view, &r);
    if (light->kind == LIGHT_RECT && rect_intersect(light->rect, &r, &t))
        rect_surface(light->rect, &r, t, &s);
    else if (light->kind == LIGHT_SPHERE &&
             sphere_intersect(light->sphere, &r, &t))
        sphere_surface(light->sphere, &r, t, &s);
    else
        return 0.0;
    return light_pdf(light, view->point, direction, s.position,
                     s.geometric_normal);
}

/* What light_pdf says of a pick; of a mesh only the mesh knows the normal. */
static float pdf_again(const struct view *view, const struct light_sample *s)
{
    const struct light *light = view->light;
    vec3 normal = vec3_make(0.0f, 0.0f, 0.0f);
    if (light->kind == LIGHT_RECT)
        normal = light->rect->normal;
    if (light->kind == LIGHT_MESH)
        return s->pdf;
    return light_pdf(light, view->point, s->direction, s->target, normal);
}

static bool pick_direction(const void *context, vec2 random, vec3 *direction)
{
    const struct view *view = context;
    struct light_sample s;
    if (!light_sample(view->light, view->point, random, &s))
        return false;
    TEST_ASSERT_FALSE(s.delta || s.infinite);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 1.0f, vec3_length(s.direction));
    TEST_ASSERT_EQUAL_FLOAT(3.0f, s.radiance.r);
    TEST_ASSERT_FLOAT_WITHIN(1e-3f * s.pdf, s.pdf, pdf_again(view, &s));
    *direction = s.direction;
    return true;
}

/* The cone that holds a ball of this radius; all directions from inside. */
static double cone_around(double distance, double radius)
{
    if (distance <= radius)
        return 2.0;
    double sine = radius / distance;
    return 1.02 * sine * sine / (1.0 + sqrt(1.0 - sine * sine));
}

static void expect_density(const struct light *light, vec3 point, vec3 center,
                           float radius, double integral)
{
    struct view view = {light, point};
    vec3 way = vec3_sub(center, point);
    struct density_test test = {
        .context = &view,
        .sample = pick_direction,
        .pdf = seen_density,
        .axis = vec3_normalize(way),
        .one_minus_cosine = cone_around((double)vec3_length(way), radius),
        .failed_share = 1.0 - integral,
        .rows = 16,
        .columns = 24,
        .subdivisions = 48,
        .samples = 100000};
    struct density_result r = density_compare(&test);
    TEST_ASSERT_EQUAL_INT(0, r.outside);
    TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(2e-3, integral, r.integral,
                                      "integral of the density");
    TEST_ASSERT_TRUE_MESSAGE(r.chi_squared < r.limit,
                             "the samples follow the density");
}

static void a_rectangle_follows_its_density(void)
{
    static const vec3 points[] = {{0.0f, 0.0f, 0.0f},
                                  {3.0f, 2.0f, -1.0f},
                                  {0.4f, 0.2f, 1.5f},
                                  {4.0f, 0.0f, 1.6f},
                                  {-50.0f, 30.0f, -80.0f}};
    struct rect rects[2] = {lamp(), skewed()};
    struct light light = rect_light(&rects[0]);
    for (int i = 0; i < 5; i++)
        expect_density(&light, points[i], rects[0].center, 1.2f, 1.0);
    light = rect_light(&rects[1]);
    vec3 front = vec3_step(rects[1].center, 1.0f, rects[1].normal);
    for (int i = 0; i < 3; i++) {
        vec3 point = vec3_step(front, 0.3f * (float)i, rects[1].side_x);
        expect_density(&light, point, rects[1].center, 1.2f, 1.0);
    }
}

static void a_sphere_follows_its_density(void)
{
    const struct sphere sphere = {{1.0f, 2.0f, 3.0f}, 0.5f};
    struct light light = sphere_light(&sphere);
    static const float distances[] = {0.5001f, 0.6f, 1.0f, 20.0f};
    vec3 way = vec3_normalize(vec3_make(0.3f, -0.5f, 0.7f));
    for (int i = 0; i < 4; i++)
        expect_density(&light, vec3_step(sphere.center, distances[i], way),
                       sphere.center, sphere.radius, 1.0);
}

/* What faces away is picked in vain: the density lacks its share of area. */
static double front_share(const struct mesh *m, vec3 point)
{
    double front = 0.0, all = 0.0;
    for (uint32_t i = 0; i < m->triangle_count; i++) {
        vec3 p[3];
        mesh_corners(m, i, p);
        vec3 n = vec3_cross(vec3_sub(p[1], p[0]), vec3_sub(p[2], p[0]));
        all += (double)vec3_length(n);
        if (vec3_dot(n, vec3_sub(point, p[0])) > 0.0f)
            front += (double)vec3_length(n);
    }
    return front / all;
}

static void a_mesh_follows_its_density(void)
{
    const vec3 zero = {0.0f, 0.0f, 0.0f};
    const vec3 above = {0.2f, 0.3f, 2.0f}, aside = {1.3f, -2.0f, 1.4f};
    const struct mesh *meshes[2] = {&octahedron, &dish};
    const float radii[2] = {2.0f, 1.6f};
    for (int i = 0; i < 2; i++) {
        struct light light = mesh_light(meshes[i]);
        expect_density(&light, above, zero, radii[i],
                       front_share(meshes[i], above));
        expect_density(&light, aside, zero, radii[i],
                       front_share(meshes[i], aside));
        light_free(&light);
    }
}

/* ---- closed forms ---- */

/* Irradiance (red) at a point with a normal, by an even grid of numbers. */
static double irradiance(const struct light *light, vec3 point, vec3 normal)
{
    enum { SIDE = 512 };
    double sum = 0.0;
    for (int i = 0; i < SIDE * SIDE; i++) {
        vec2 random = vec2_make(((float)(i % SIDE) + 0.5f) / SIDE,
                                ((float)(i / SIDE) + 0.5f) / SIDE);
        struct light_sample s;
        if (!light_sample(light, point, random, &s))
            continue;
        double cosine = fmax(0.0, (double)vec3_dot(s.direction, normal));
        sum += (double)s.radiance.r * cosine / (double)s.pdf;
    }
    return sum / ((double)SIDE * SIDE);
}

static double edge_irradiance(vec3 a, vec3 b, vec3 normal)
{
    vec3 c = vec3_cross(a, b);
    double angle = atan2((double)vec3_length(c), (double)vec3_dot(a, b));
    return angle * (double)vec3_dot(vec3_normalize(c), normal);
}

/* J. Lambert's formula (Photometria, 1760) for a polygon above the horizon:
 * L / 2 times the sum over its edges of angle x cosine. */
static double polygon_irradiance(double radiance, const vec3 corners[],
                                 int count, vec3 point, vec3 normal)
{
    double sum = 0.0;
    for (int i = 0; i < count; i++)
        sum +=
            edge_irradiance(vec3_sub(corners[i], point),
                            vec3_sub(corners[(i + 1) % count], point), normal);
    return 0.5 * radiance * fabs(sum);
}

static void rect_corners(const struct rect *r, vec3 corners[4])
{
    for (int i = 0; i < 4; i++) {
        float x = i == 0 || i == 3 ? -0.5f : 0.5f, y = i < 2 ? -0.5f : 0.5f;
        corners[i] =
            vec3_step(vec3_step(r->center, x, r->side_x), y, r->side_y);
    }
}

static void a_rectangle_gives_lamberts_irradiance(void)
{
    static const vec3 points[] = {{0.0f, 0.0f, 0.0f},
                                  {2.0f, 1.0f, -0.5f},
                                  {0.3f, -0.2f, 1.5f},
                                  {-20.0f, 5.0f, -10.0f}};
    static const vec3 normals[] = {
        {0.0f, 0.0f, 1.0f}, {-0.6f, 0.0f, 0.8f}, {0.0f, 0.28f, 0.96f}};
    struct rect rect = lamp();
    struct light light = rect_light(&rect);
    vec3 corners[4];
    rect_corners(&rect, corners);
    for (int i = 0; i < 4; i++) {
        vec3 normal = normals[i % 3];
        double want = polygon_irradiance(3.0, corners, 4, points[i], normal);
        TEST_ASSERT_DOUBLE_WITHIN(2e-4 * want, want,
                                  irradiance(&light, points[i], normal));
    }
}

/* The same lamp as two triangles. */
static void a_mesh_gives_lamberts_irradiance(void)
{
    vec3 corners[4];
    uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
    struct rect rect = lamp();
    rect_corners(&rect, corners);
    struct mesh mesh = {corners, NULL, NULL, indices, 4, 2};
    struct light light = mesh_light(&mesh);
    vec3 point = vec3_make(1.0f, 0.3f, 0.2f), up = vec3_make(0, 0, 1);
    double want = polygon_irradiance(3.0, corners, 4, point, up);
    TEST_ASSERT_DOUBLE_WITHIN(1e-3 * want, want, irradiance(&light, point, up));
    light_free(&light);
}

static void a_sphere_gives_pi_l_sine_squared(void)
{
    const struct sphere sphere = {{0.0f, 0.0f, 5.0f}, 2.0f};
    struct light light = sphere_light(&sphere);
    static const float tilts[] = {0.0f, 0.5f, 1.0f};
    static const float heights[] = {0.0f, 2.5f, -1000.0f};
    for (int i = 0; i < 9; i++) {
        vec3 normal = vec3_make(sinf(tilts[i % 3]), 0.0f, cosf(tilts[i % 3]));
        vec3 point = vec3_make(0.0f, 0.0f, heights[i / 3]);
        double sine = 2.0 / (5.0 - (double)heights[i / 3]);
        if (asin(sine) + (double)tilts[i % 3] > 1.57)
            continue; /* partly below the horizon */
        double want = acos(-1.0) * 3.0 * sine * sine * (double)normal.z;
        TEST_ASSERT_DOUBLE_WITHIN(3e-4 * want, want,
                                  irradiance(&light, point, normal));
    }
}

/* The mean of 1 / density is the solid angle: here of the octant that a
 * triangle from axis to axis fills, 4 pi / 8. */
static void a_triangle_that_fills_an_octant(void)
{
    vec3 corners[3] = {{1, 0, 0}, {0, 0, 1}, {0, 1, 0}};
    uint32_t indices[3] = {0, 1, 2};
    struct mesh mesh = {corners, NULL, NULL, indices, 3, 1};
    struct light light = mesh_light(&mesh);
    double sum = 0.0;
    for (int i = 0; i < 256 * 256; i++) {
        struct light_sample s;
        vec2 random = vec2_make(((float)(i % 256) + 0.5f) / 256.0f,
                                ((float)(i / 256) + 0.5f) / 256.0f);
        TEST_ASSERT_TRUE(light_sample(&light, vec3_make(0, 0, 0), random, &s));
        sum += 1.0 / (double)s.pdf;
    }
    TEST_ASSERT_DOUBLE_WITHIN(1e-4, acos(-1.0) / 2.0, sum / (256.0 * 256.0));
    light_free(&light);
}

/* ---- where no light is seen ---- */

static void nothing_shines_backwards(void)
{
    struct rect rect = lamp();
    struct light light = rect_light(&rect);
    struct light_sample s;
    vec2 random = vec2_make(0.3f, 0.6f);
    vec3 above = vec3_make(0.1f, 0.2f, 3.0f), down = vec3_make(0, 0, -1);
    vec3 level = vec3_make(5.0f, 0.0f, 2.0f);
    TEST_ASSERT_FALSE(light_sample(&light, above, random, &s));
    TEST_ASSERT_FALSE(light_sample(&light, level, random, &s));
    TEST_ASSERT_EQUAL_FLOAT(
        0.0f, light_pdf(&light, above, down, rect.center, rect.normal));
    TEST_ASSERT_TRUE(
        rgb_is_black(light_emitted(&light, rect.normal, vec3_make(0, 0, 1))));
    TEST_ASSERT_EQUAL_FLOAT(2.0f, light_emitted(&light, rect.normal, down).g);
}

static void a_point_on_the_light_is_no_trap(void)
{
    struct rect rect = lamp();
    struct light light = rect_light(&rect);
    struct light_sample s;
    TEST_ASSERT_FALSE(
        light_sample(&light, rect.center, vec2_make(0.5f, 0.5f), &s));
}

static void inside_a_sphere_it_is_dark(void)
{
    const struct sphere sphere = {{1.0f, 0.0f, 0.0f}, 2.0f};
    struct light light = sphere_light(&sphere);
    struct light_sample s;
    vec3 inside = vec3_make(0.5f, 0.5f, 1.0f), x = vec3_make(1, 0, 0);
    TEST_ASSERT_FALSE(light_sample(&light, inside, vec2_make(0.1f, 0.9f), &s));
    TEST_ASSERT_FALSE(
        light_sample(&light, sphere.center, vec2_make(0.1f, 0.9f), &s));
    TEST_ASSERT_EQUAL_FLOAT(
        0.0f, light_pdf(&light, inside, x, vec3_make(3, 0, 0), x));
}

static void a_black_light_is_never_picked(void)
{
    struct rect rect = lamp();
    struct light light = rect_light(&rect);
    struct light_sample s;
    light.radiance = rgb_grey(0.0f);
    TEST_ASSERT_FALSE(
        light_sample(&light, vec3_make(0, 0, 0), vec2_make(0.5f, 0.5f), &s));
}

static void a_mesh_without_area_is_dark(void)
{
    vec3 corners[3] = {{1, 1, 1}, {2, 2, 2}, {3, 3, 3}};
    uint32_t indices[3] = {0, 1, 2};
    struct mesh flat = {corners, NULL, NULL, indices, 3, 1}, empty = {0};
    struct light lights[2] = {mesh_light(&flat), mesh_light(&empty)};
    for (int i = 0; i < 2; i++) {
        struct light_sample s;
        TEST_ASSERT_FALSE(light_sample(&lights[i], vec3_make(0, 0, 0),
                                       vec2_make(0.5f, 0.5f), &s));
        TEST_ASSERT_EQUAL_FLOAT(0.0f, light_power(&lights[i], 1.0f));
        light_free(&lights[i]);
    }
}

/* ---- digits ---- */

static void a_sphere_keeps_its_digits_near_and_far(void)
{
    static const float distances[] = {1.000001f, 1.01f, 3.0f, 1e4f, 1e8f};
    const struct sphere sphere = {{0.0f, 0.0f, 0.0f}, 1.0f};
    for (int i = 0; i < 5; i++) {
        double d = distances[i], sine2 = 1.0 / (d * d);
        double height = sine2 / (1.0 + sqrt(1.0 - sine2));
        double want = 1.0 / (2.0 * acos(-1.0) * height);
        vec3 point = vec3_make(0.0f, distances[i], 0.0f);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6 * want, want,
                                  (double)sphere_light_pdf(&sphere, point));
    }
}

/* The place is on the sphere, on the near side, and in the direction. */
static void a_sphere_is_seen_where_the_direction_says(void)
{
    static const float distances[] = {1.001f, 1.5f, 40.0f, 1e5f};
    const struct sphere sphere = {{0.0f, 0.0f, 0.0f}, 1.0f};
    for (int i = 0; i < 40000; i++) {
        uint64_t key = random_key(3, 0, (uint64_t)i);
        vec2 random = vec2_make(random_float(key, 0), random_float(key, 1));
        float d = distances[i % 4];
        vec3 point = vec3_make(0.6f * d, -0.8f * d, 0.0f);
        vec3 direction, place, normal;
        TEST_ASSERT_TRUE(sphere_light_sample(&sphere, point, random, &direction,
                                             &place, &normal));
        vec3 way = vec3_sub(place, point);
        vec3 off = vec3_step(way, -vec3_dot(way, direction), direction);
        TEST_ASSERT_FLOAT_WITHIN(1e-6f, 1.0f, vec3_length(place));
        TEST_ASSERT_TRUE(vec3_length(off) < 1e-6f * (1.0f + d));
        TEST_ASSERT_TRUE(vec3_dot(normal, way) < 1e-5f * (1.0f + d));
    }
}

static bool meets(const struct light *light, const ray *r)
{
    float t;
    if (light->kind == LIGHT_RECT)
        return rect_intersect(light->rect, r, &t);
    if (light->kind == LIGHT_SPHERE)
        return sphere_intersect(light->sphere, r, &t);
    for (uint32_t i = 0; i < light->mesh->triangle_count; i++) {
        vec3 p[3];
        struct triangle_hit hit;
        mesh_corners(light->mesh, i, p);
        if (triangle_intersect(p, r, &hit))
            return true;
    }
    return false;
}

/* Of many ways to a light, how many are stopped by the light itself? */
static int own_shadows(const struct light *light, vec3 center)
{
    int count = 0;
    for (int i = 0; i < 100000; i++) {
        uint64_t key = random_key(11, 0, (uint64_t)i);
        struct light_sample sample;
        struct surface s = {0};
        float distance = 0.3f * powf(10.0f, 4.0f * random_float(key, 4));
        s.geometric_normal =
            warp_sphere(vec2_make(random_float(key, 0), random_float(key, 1)));
        s.position = vec3_step(center, distance, s.geometric_normal);
        vec2 random = vec2_make(random_float(key, 2), random_float(key, 3));
        if (!light_sample(light, s.position, random, &sample))
            continue;
        ray r = surface_segment(&s, sample.target);
        count += meets(light, &r);
    }
    return count;
}

static void no_light_stands_in_its_own_way(void)
{
    struct rect rects[2] = {lamp(), skewed()};
    const struct sphere spheres[2] = {{{1.0f, 2.0f, 3.0f}, 0.2f},
                                      {{-200.0f, 30.0f, 5.0f}, 0.1f}};
    for (int i = 0; i < 2; i++) {
        struct light light = rect_light(&rects[i]);
        TEST_ASSERT_EQUAL_INT(0, own_shadows(&light, rects[i].center));
        light = sphere_light(&spheres[i]);
        TEST_ASSERT_EQUAL_INT(0, own_shadows(&light, spheres[i].center));
    }
    struct light light = mesh_light(&octahedron);
    TEST_ASSERT_EQUAL_INT(0, own_shadows(&light, vec3_make(0, 0, 0)));
    light_free(&light);
}

static void power_is_area_times_pi_times_luminance(void)
{
    struct rect rect = lamp();
    const struct sphere sphere = {{0.0f, 0.0f, 0.0f}, 2.0f};
    double l = rgb_luminance(rgb_make(3.0f, 2.0f, 1.0f)), pi = acos(-1.0);
    struct light light = rect_light(&rect);
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, (float)(2.0 * pi * l),
                             light_power(&light, 9.0f));
    light = sphere_light(&sphere);
    TEST_ASSERT_FLOAT_WITHIN(1e-2f, (float)(16.0 * pi * pi * l),
                             light_power(&light, 9.0f));
    TEST_ASSERT_FALSE(light_is_delta(&light));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(a_rectangle_follows_its_density);
    RUN_TEST(a_sphere_follows_its_density);
    RUN_TEST(a_mesh_follows_its_density);
    RUN_TEST(a_rectangle_gives_lamberts_irradiance);
    RUN_TEST(a_mesh_gives_lamberts_irradiance);
    RUN_TEST(a_sphere_gives_pi_l_sine_squared);
    RUN_TEST(a_triangle_that_fills_an_octant);
    RUN_TEST(nothing_shines_backwards);
    RUN_TEST(a_point_on_the_light_is_no_trap);
    RUN_TEST(inside_a_sphere_it_is_dark);
    RUN_TEST(a_black_light_is_never_picked);
    RUN_TEST(a_mesh_without_area_is_dark);
    RUN_TEST(a_sphere_keeps_its_digits_near_and_far);
    RUN_TEST(a_sphere_is_seen_where_the_direction_says);
    RUN_TEST(no_light_stands_in_its_own_way);
    RUN_TEST(power_is_area_times_pi_times_luminance);
    return UNITY_END();
}
