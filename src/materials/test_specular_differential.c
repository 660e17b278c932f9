/* test_specular_differential.c - against neighbouring rays really traced. */
#include "materials/specular_differential.h"

#include "materials/mirror.h"
#include "materials/refraction.h"
#include "materials/test_materials.h"
#include "shapes/mesh.h"
#include "shapes/sphere.h"
#include "shapes/triangle.h"
#include "unity.h"

/* What is compared here is bent by the exercise of assignment 04. */
void setUp(void)
{
    vec3 in, up = {0.0f, 0.0f, 1.0f};
    bool through = refraction_direction(up, unit(0.6f, 0.0f, 0.8f), 1.5f, &in);
    if (!through || fabsf(in.x + 0.4f) > 1e-5f)
        TEST_IGNORE_MESSAGE("waits for assignment 04: light is not bent");
}

void tearDown(void)
{
}

enum { MOST_BOUNCES = 4 };

/* A ray for each (x, y), and what it meets: a sphere, or if mesh is given its
 * one triangle. */
struct setting {
    vec3 origin, origin_by_x, origin_by_y;
    vec3 forward, right, down;
    struct material material;
    struct sphere sphere;
    const struct mesh *mesh;
    int bounces;
    float picks[MOST_BOUNCES]; /* glass: 0 reflects, 0.999 refracts */
};

/* A view of a sphere that neither starts nor ends in a symmetric way. */
static struct setting sphere_setting(enum material_kind kind)
{
    struct setting c = {.origin = {0.4f, -0.3f, 3.0f},
                        .origin_by_x = {0.1f, 0.02f, 0.0f},
                        .origin_by_y = {-0.03f, 0.2f, 0.1f},
                        .right = {0.9f, 0.1f, 0.2f},
                        .down = {0.0f, -0.8f, 0.1f},
                        .sphere = {{0.1f, 0.2f, -0.1f}, 1.1f}};
    struct material m = {.kind = kind, .eta = 1.5f};
    m.reflectance = m.transmittance = rgb_grey(1.0f);
    c.forward = unit(0.05f, 0.1f, -1.0f);
    c.material = m;
    return c;
}

static vec3 toward(const struct setting *c, float x, float y)
{
    return vec3_step(vec3_step(c->forward, x, c->right), y, c->down);
}

static struct ray_differential first_differential(const struct setting *c)
{
    struct ray_differential d = {c->origin_by_x, c->origin_by_y, c->right,
                                 c->down};
    vec3 v = c->forward; /* of length one */
    d.direction_dx = vec3_step(c->right, -vec3_dot(v, c->right), v);
    d.direction_dy = vec3_step(c->down, -vec3_dot(v, c->down), v);
    return d;
}

static struct surface meet(const struct setting *c, const ray *r)
{
    float t = 0.0f;
    if (c->mesh != NULL) {
        vec3 corners[3];
        struct triangle_hit hit;
        mesh_corners(c->mesh, 0, corners);
        TEST_ASSERT_TRUE(triangle_intersect(corners, r, &hit));
        struct surface s;
        mesh_surface(c->mesh, 0, &hit, &s);
        return s;
    }
    TEST_ASSERT_TRUE(sphere_intersect(&c->sphere, r, &t));
    struct surface s;
    sphere_surface(&c->sphere, r, t, &s);
    return s;
}

/* The ray after all bounces; d, if given, is carried along. */
static ray trace(const struct setting *c, float x, float y,
                 struct ray_differential *d)
{
    vec3 origin =
        vec3_step(vec3_step(c->origin, x, c->origin_by_x), y, c->origin_by_y);
    ray r = ray_make(origin, vec3_normalize(toward(c, x, y)), 0.0f, INFINITY);
    for (int i = 0; i < c->bounces; i++) {
        struct surface s = meet(c, &r);
        struct scatter way;
        const float random[3] = {0.0f, 0.0f, c->picks[i]};
        TEST_ASSERT_TRUE(material_sample(
            &c->material, &s, vec3_negate(r.direction), random, &way));
        if (d != NULL)
            material_specular_differential(&c->material, &s, &r, d, &way, d);
        r = ray_make(s.position, way.incoming, 1e-3f, INFINITY);
    }
    return r;
}

static void expect_near(vec3 expected, vec3 found)
{
    float size = 1.0f + vec3_length(expected);
    float off = vec3_length(vec3_sub(expected, found));
    TEST_ASSERT_FLOAT_WITHIN(2e-3f, 0.0f, off / size);
}

static const float step = 2e-3f;

static vec3 slope(vec3 after, vec3 before)
{
    return vec3_scale(vec3_sub(after, before), 0.5f / step);
}

/* Differences of rays a little to either side. */
static void expect_true_differential(const struct setting *c)
{
    struct ray_differential d = first_differential(c);
    trace(c, 0.0f, 0.0f, &d);
    ray left = trace(c, -step, 0.0f, NULL), right = trace(c, step, 0.0f, NULL);
    ray up = trace(c, 0.0f, -step, NULL), down = trace(c, 0.0f, step, NULL);
    expect_near(slope(right.direction, left.direction), d.direction_dx);
    expect_near(slope(down.direction, up.direction), d.direction_dy);
    expect_near(slope(right.origin, left.origin), d.origin_dx);
    expect_near(slope(down.origin, up.origin), d.origin_dy);
    TEST_ASSERT_TRUE(vec3_length(d.origin_dx) > 0.05f);
}

static void through_a_glass_sphere(void)
{
    struct setting c = sphere_setting(MATERIAL_REFRACTION);
    c.bounces = 1;
    expect_true_differential(&c);
    c.bounces = 2;
    expect_true_differential(&c);
    c.material.eta = 0.7f;
    expect_true_differential(&c);
}

static void off_a_sphere(void)
{
    struct setting c = sphere_setting(MATERIAL_GLASS);
    c.bounces = 1;
    expect_true_differential(&c);
}

static void round_inside_a_sphere(void)
{
    struct setting c = sphere_setting(MATERIAL_GLASS);
    c.bounces = 4;
    c.picks[0] = c.picks[3] = 0.999f;
    expect_true_differential(&c);
}

static void totally_reflected(void)
{
    struct setting c = sphere_setting(MATERIAL_REFRACTION);
    c.origin = vec3_make(0.1f, 1.1f, 0.1f);
    c.forward = unit(0.9f, 0.2f, 0.1f);
    c.bounces = 1;
    ray r = trace(&c, 0.0f, 0.0f, NULL);
    vec3 inwards = vec3_sub(c.sphere.center, r.origin);
    TEST_ASSERT_TRUE(vec3_dot(r.direction, inwards) > 0.0f);
    expect_true_differential(&c);
    c.bounces = 3;
    expect_true_differential(&c);
}

static uint32_t corners[] = {0, 1, 2};
static vec3 positions[] = {
    {-4.0f, -3.0f, 0.2f}, {5.0f, -2.0f, -0.5f}, {-1.0f, 6.0f, 0.4f}};
static vec2 uvs[] = {{0.1f, 0.9f}, {0.8f, 0.7f}, {0.3f, 0.2f}};

/* Through and off a triangle, from the front and from behind. */
static void expect_triangle(const struct mesh *mesh)
{
    for (int i = 0; i < 4; i++) {
        struct setting c = sphere_setting(MATERIAL_GLASS);
        c.mesh = mesh;
        c.bounces = 1;
        c.picks[0] = i & 1 ? 0.999f : 0.0f;
        if (i & 2) {
            c.origin.z = -c.origin.z;
            c.forward.z = -c.forward.z;
        }
        expect_true_differential(&c);
    }
}

static void a_flat_triangle(void)
{
    struct mesh mesh = {positions, NULL, uvs, corners, 3, 1};
    expect_triangle(&mesh);
}

static void a_smooth_triangle(void)
{
    vec3 normals[3] = {unit(-0.3f, -0.2f, 1.0f), unit(0.4f, -0.1f, 1.0f),
                       unit(-0.1f, 0.3f, 1.0f)};
    struct mesh mesh = {positions, normals, uvs, corners, 3, 1};
    expect_triangle(&mesh);
    mesh.uvs = NULL;
    expect_triangle(&mesh);
}

/* The direction that follows outgoing; false where it was turned about the
 * other normal than geometric says. */
static bool turned(const struct material *m, const struct surface *s,
                   vec3 outgoing, bool geometric, struct scatter *way)
{
    vec3 n = s->geometric_normal, about;
    const float random[3] = {0.0f, 0.0f, 0.0f};
    if (m->kind == MATERIAL_GLASS) /* reflects: the random number is 0 */
        about = mirror_direction(n, outgoing);
    else
        refraction_direction(n, outgoing, m->eta, &about);
    if (!material_sample(m, s, outgoing, random, way))
        return false;
    float off = vec3_length(vec3_sub(about, way->incoming));
    return (off < 1e-5f) == geometric;
}

static bool expect_turned(const struct material *m, const struct surface *s,
                          vec3 o, bool geometric)
{
    vec3 x, y;
    struct scatter way, before, after;
    vec3_frame(o, &x, &y);
    vec3 o_before = vec3_normalize(vec3_step(o, -step, x));
    vec3 o_after = vec3_normalize(vec3_step(o, step, x));
    if (!turned(m, s, o, geometric, &way) ||
        !turned(m, s, o_before, geometric, &before) ||
        !turned(m, s, o_after, geometric, &after) ||
        before.transmitted != after.transmitted ||
        fabsf(vec3_dot(o, s->geometric_normal)) < 0.05f ||
        fabsf(vec3_dot(way.incoming, s->geometric_normal)) < 0.3f ||
        fabsf(vec3_dot(way.incoming, s->shading_normal)) < 0.3f)
        return false;
    ray r = ray_make(vec3_add(s->position, o), vec3_negate(o), 0.0f, INFINITY);
    struct ray_differential d = {.direction_dx = vec3_negate(x)};
    material_specular_differential(m, s, &r, &d, &way, &d);
    expect_near(slope(after.incoming, before.incoming), d.direction_dx);
    return true;
}

/* At the rim of a mesh, where the geometric normal stands in. */
static void the_normal_in_use_counts(void)
{
    struct setting c = sphere_setting(MATERIAL_REFRACTION);
    struct surface s = smooth_surface();
    int smooth = 0, geometric = 0;
    for (uint64_t i = 0; i < 5000; i++) {
        c.material.kind = i % 2 ? MATERIAL_REFRACTION : MATERIAL_GLASS;
        smooth += expect_turned(&c.material, &s, some_direction(i), false);
        geometric += expect_turned(&c.material, &s, some_direction(i), true);
    }
    TEST_ASSERT_TRUE(smooth > 500 && geometric > 100);
}

static void a_point_stays_a_point(void)
{
    static const struct ray_differential none;
    struct setting c = sphere_setting(MATERIAL_REFRACTION);
    struct ray_differential d = none;
    c.bounces = 2;
    trace(&c, 0.0f, 0.0f, &d);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, vec3_length(d.origin_dx));
    TEST_ASSERT_EQUAL_FLOAT(0.0f, vec3_length(d.direction_dy));
}

/* Along the surface the change has no bound; it must not become a NaN. */
static void glancing_rays_are_finite(void)
{
    struct setting c = sphere_setting(MATERIAL_REFRACTION);
    struct surface s = flat_surface();
    for (float off = 1e-2f; off > 1e-9f; off *= 0.3f) {
        vec3 o = direction_at(&s, 1.57079633f - off, 0.3f);
        ray r = ray_make(o, vec3_negate(o), 0.0f, INFINITY);
        struct ray_differential d = first_differential(&c);
        struct scatter way;
        const float random[3] = {0.0f, 0.0f, 0.0f};
        TEST_ASSERT_TRUE(material_sample(&c.material, &s, o, random, &way));
        material_specular_differential(&c.material, &s, &r, &d, &way, &d);
        TEST_ASSERT_TRUE(vec3_is_finite(d.origin_dx));
        TEST_ASSERT_TRUE(vec3_is_finite(d.direction_dx));
        TEST_ASSERT_TRUE(vec3_is_finite(d.direction_dy));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(through_a_glass_sphere);
    RUN_TEST(off_a_sphere);
    RUN_TEST(round_inside_a_sphere);
    RUN_TEST(totally_reflected);
    RUN_TEST(a_flat_triangle);
    RUN_TEST(a_smooth_triangle);
    RUN_TEST(the_normal_in_use_counts);
    RUN_TEST(a_point_stays_a_point);
    RUN_TEST(glancing_rays_are_finite);
    return UNITY_END();
}
