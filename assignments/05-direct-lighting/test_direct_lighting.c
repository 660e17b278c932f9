/* test_direct_lighting.c - the public tests of assignment 05.
 *
 * Most look straight down at the middle of a floor, from y = 3, with a lamp
 * somewhere above and perhaps a ball in between:
 *
 *        eye  o     * lamp at (0, 2, 0)
 *             |    /
 *             |  (_)  ball
 *             | /
 *      -------+-------  floor, 10 by 10, y = 0, its normal is +y
 *
 * Read a test's name and its message; the contracts are in
 * integrators/direct_lighting.h and lights/point_light.h. */
#include "integrators/direct_lighting.h"

#include <string.h>

#include "base/constants.h"
#include "base/memory.h"
#include "lights/point_light.h"
#include "unity.h"

static struct scene scene;
static struct texture paint = {.kind = TEXTURE_CONSTANT,
                               .color = {{0.5f, 0.25f, 1.0f}, {0, 0, 0}}};
static struct material floor_material;

void setUp(void)
{
    struct scene empty = {.environment = -1};
    struct material plain = {.kind = MATERIAL_DIFFUSE, .albedo = &paint};
    scene = empty;
    floor_material = plain;
    scene.objects = mem_alloc(3, sizeof *scene.objects);
    scene.lights = mem_alloc(1, sizeof *scene.lights);
    scene.light_count = 1;
}

void tearDown(void)
{
    scene_free(&scene);
}

/* --- Making scenes ------------------------------------------------------ */

static void add_rect(vec3 center, vec3 side_x, vec3 side_y)
{
    struct object o = {
        .kind = OBJECT_RECT, .material = &floor_material, .light = -1};
    vec3 normal = vec3_cross(side_x, side_y);
    o.rect.center = center;
    o.rect.side_x = side_x;
    o.rect.side_y = side_y;
    o.rect.area = vec3_length(normal);
    o.rect.normal = vec3_normalize(normal);
    scene.objects[scene.object_count++] = o;
}

static void add_floor(void)
{
    add_rect(vec3_make(0, 0, 0), vec3_make(10, 0, 0), vec3_make(0, 0, -10));
}

static void add_ball(vec3 center, float radius)
{
    struct object o = {.kind = OBJECT_SPHERE,
                       .sphere = {center, radius},
                       .material = &floor_material,
                       .light = -1};
    scene.objects[scene.object_count++] = o;
}

/* The floor's middle, seen from `eye`; all objects have to be added before. */
static struct vertex look_from(vec3 eye)
{
    struct tracer t = {&scene, NULL, NULL};
    struct ray_differential none = {0};
    struct vertex v;
    struct error err;
    TEST_ASSERT_TRUE(scene_prepare(&scene, ACCEL_LINEAR, &err));
    ray r = ray_make(eye, vec3_negate(eye), 0.0f, INFINITY);
    TEST_ASSERT_TRUE_MESSAGE(tracer_hit(&t, &r, &none, &v), "the test's own");
    return v;
}

/* What the floor sees of a lamp there; its irradiance is 2, 4, 8 W m^-2. */
static struct light_sample lamp_at(vec3 place)
{
    struct light_sample s = {.target = place, .delta = true, .pdf = 1.0f};
    s.direction = vec3_normalize(place);
    s.radiance = rgb_make(2.0f, 4.0f, 8.0f);
    return s;
}

static void expect(rgb want, rgb got, const char *why)
{
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(1e-4f * want.r, want.r, got.r, why);
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(1e-4f * want.g, want.g, got.g, why);
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(1e-4f * want.b, want.b, got.b, why);
}

/* albedo / pi x irradiance x cosine: (1, 1, 8) / pi for a cosine of 1. */
static rgb lit(float cosine)
{
    return rgb_scale(rgb_make(1.0f, 1.0f, 8.0f), cosine / PI);
}

static const rgb BLACK = {0.0f, 0.0f, 0.0f};
static const vec3 ABOVE = {0.0f, 3.0f, 0.0f};
static const vec3 BESIDE = {-1.0f, 3.0f, 0.0f};

/* --- The point light ----------------------------------------------------- */

static void a_lamp_gives_its_flux_over_the_sphere(void)
{
    rgb flux = rgb_make(4.0f * PI, 8.0f * PI, 0.0f);
    expect(rgb_make(1.0f, 2.0f, 0.0f), point_light_irradiance(flux, 1.0f),
           "a sphere of radius 1 has an area of 4 pi");
}

static void twice_as_far_is_a_quarter(void)
{
    rgb flux = rgb_make(4.0f * PI, 8.0f * PI, 16.0f * PI);
    expect(rgb_make(0.25f, 0.5f, 1.0f), point_light_irradiance(flux, 2.0f),
           "at 2 m the sphere is four times as large as at 1 m");
    expect(rgb_make(4.0f, 8.0f, 16.0f), point_light_irradiance(flux, 0.5f),
           "at 0.5 m the sphere is a quarter of that at 1 m");
}

/* --- Light on a surface -------------------------------------------------- */

static void a_lamp_straight_above(void)
{
    add_floor();
    struct vertex v = look_from(BESIDE);
    struct light_sample s = lamp_at(vec3_make(0.0f, 2.0f, 0.0f));
    expect(lit(1.0f), direct_light(&scene, &v, &s),
           "albedo / pi x irradiance, the cosine is 1");
}

static void a_slanting_lamp_gives_less(void)
{
    add_floor();
    struct vertex v = look_from(ABOVE);
    struct light_sample s = lamp_at(vec3_make(4.0f, 3.0f, 0.0f));
    expect(lit(0.6f), direct_light(&scene, &v, &s),
           "the direction (0.8, 0.6, 0) has a cosine of 0.6 with the floor");
}

static void the_viewer_may_slant_too(void)
{
    add_floor();
    struct vertex v = look_from(vec3_make(4.0f, 3.0f, 0.0f));
    struct light_sample s = lamp_at(vec3_make(0.0f, 2.0f, 0.0f));
    expect(lit(1.0f), direct_light(&scene, &v, &s),
           "a diffuse floor is as bright from everywhere: no cosine there");
}

static void the_shading_normal_counts(void)
{
    add_floor();
    struct vertex v = look_from(ABOVE);
    v.surface.shading_normal = vec3_make(0.6f, 0.8f, 0.0f);
    struct light_sample s = lamp_at(vec3_make(0.0f, 2.0f, 0.0f));
    expect(lit(0.8f), direct_light(&scene, &v, &s),
           "how bright a smooth mesh is, its shading normal decides");
}

static void a_density_divides(void)
{
    add_floor();
    struct vertex v = look_from(ABOVE);
    struct light_sample s = lamp_at(vec3_make(0.0f, 2.0f, 0.0f));
    s.delta = false;
    s.pdf = 4.0f;
    expect(lit(0.25f), direct_light(&scene, &v, &s),
           "a direction picked with density 4 counts a quarter");
}

static void a_lamp_below_the_floor_gives_nothing(void)
{
    add_floor();
    struct vertex v = look_from(ABOVE);
    struct light_sample s = lamp_at(vec3_make(0.0f, -2.0f, 0.0f));
    expect(BLACK, direct_light(&scene, &v, &s), "it is behind the floor");
}

static void the_back_of_a_floor_is_black(void)
{
    add_floor();
    struct vertex v = look_from(vec3_make(0.0f, -3.0f, 0.0f));
    struct light_sample s = lamp_at(vec3_make(0.0f, -2.0f, 0.0f));
    expect(BLACK, direct_light(&scene, &v, &s),
           "lamp and viewer are both behind a floor of one side");
}

static void a_floor_of_two_sides_has_a_lit_back(void)
{
    floor_material.two_sided = true;
    add_floor();
    struct vertex v = look_from(vec3_make(0.0f, -3.0f, 0.0f));
    struct light_sample s = lamp_at(vec3_make(4.0f, -3.0f, 0.0f));
    expect(lit(0.6f), direct_light(&scene, &v, &s),
           "lamp and viewer are both behind a floor with two sides");
}

/* --- Shadows ------------------------------------------------------------- */

static void a_ball_in_the_way_makes_shadow(void)
{
    add_floor();
    add_ball(vec3_make(0.0f, 1.0f, 0.0f), 0.25f);
    struct vertex v = look_from(BESIDE);
    struct light_sample s = lamp_at(vec3_make(0.0f, 2.0f, 0.0f));
    expect(BLACK, direct_light(&scene, &v, &s),
           "the ball is between floor and lamp: black, no light at all");
}

static void a_ball_beside_the_way_does_not(void)
{
    add_floor();
    add_ball(vec3_make(0.5f, 1.0f, 0.0f), 0.25f);
    struct vertex v = look_from(BESIDE);
    struct light_sample s = lamp_at(vec3_make(0.0f, 2.0f, 0.0f));
    expect(lit(1.0f), direct_light(&scene, &v, &s), "the way is free");
}

static void a_ball_behind_the_lamp_does_not(void)
{
    add_floor();
    add_ball(vec3_make(0.0f, 2.5f, 0.0f), 0.25f);
    struct vertex v = look_from(BESIDE);
    struct light_sample s = lamp_at(vec3_make(0.0f, 2.0f, 0.0f));
    expect(lit(1.0f), direct_light(&scene, &v, &s),
           "the ball is beyond the lamp: the way ends before it");
}

static void a_lamp_may_lie_on_a_ceiling(void)
{
    add_floor();
    add_rect(vec3_make(0, 2, 0), vec3_make(1, 0, 0), vec3_make(0, 0, 1));
    struct vertex v = look_from(vec3_make(-2.0f, 1.0f, 0.0f));
    struct light_sample s = lamp_at(vec3_make(0.0f, 2.0f, 0.0f));
    expect(lit(1.0f), direct_light(&scene, &v, &s),
           "the surface that holds the lamp does not hide it");
}

static void the_sun_shines_from_far_away(void)
{
    add_floor();
    add_ball(vec3_make(80.0f, 60.0f, 0.0f), 1.0f);
    struct vertex v = look_from(ABOVE);
    struct light_sample s = lamp_at(vec3_make(-4.0f, 3.0f, 0.0f));
    s.infinite = true;
    s.target = vec3_make(0.0f, 0.0f, 0.0f);
    expect(lit(0.6f), direct_light(&scene, &v, &s),
           "nothing in that direction; an infinite light has no target");
    s.direction = vec3_make(0.8f, 0.6f, 0.0f);
    expect(BLACK, direct_light(&scene, &v, &s),
           "a ball 100 m away, in the direction of the sun, hides it");
}

static void nothing_but_the_answer_changes(void)
{
    add_floor();
    add_ball(vec3_make(0.0f, 2.5f, 0.0f), 0.25f);
    struct vertex v = look_from(BESIDE), before;
    struct light_sample s = lamp_at(vec3_make(0.0f, 2.0f, 0.0f));
    memcpy(&before, &v, sizeof v);
    (void)direct_light(&scene, &v, &s);
    TEST_ASSERT_EQUAL_MEMORY_MESSAGE(&before, &v, sizeof v,
                                     "the vertex must stay as it is");
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(a_lamp_gives_its_flux_over_the_sphere);
    RUN_TEST(twice_as_far_is_a_quarter);
    RUN_TEST(a_lamp_straight_above);
    RUN_TEST(a_slanting_lamp_gives_less);
    RUN_TEST(the_viewer_may_slant_too);
    RUN_TEST(the_shading_normal_counts);
    RUN_TEST(a_density_divides);
    RUN_TEST(a_lamp_below_the_floor_gives_nothing);
    RUN_TEST(the_back_of_a_floor_is_black);
    RUN_TEST(a_floor_of_two_sides_has_a_lit_back);
    RUN_TEST(a_ball_in_the_way_makes_shadow);
    RUN_TEST(a_ball_beside_the_way_does_not);
    RUN_TEST(a_ball_behind_the_lamp_does_not);
    RUN_TEST(a_lamp_may_lie_on_a_ceiling);
    RUN_TEST(the_sun_shines_from_far_away);
    RUN_TEST(nothing_but_the_answer_changes);
    return UNITY_END();
}
