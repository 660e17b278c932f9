/* test_intersection_test.c - public tests of assignment 04, second part.
 *
 * A white wall lies in the plane z = 0. A lamp at (0, 0, 2) lights it so that
 * it sends out a radiance of 1 under the lamp. The camera is at z = 10, looks
 * straight down, and sees the wall through what a test puts in between. Clear
 * things have the index 1: light goes straight through them, also with the
 * refraction_direction that you were given.
 *
 *     z = 10   camera
 *      3 - 9   what is added: panes, lamps
 *          2   the point light: nothing added is between it and the wall
 *          0   the wall
 *
 * Read a test's name and its message; the contract is in
 * integrators/intersection_test.h. */
#include "integrators/intersection_test.h"

#include <string.h>

#include "base/memory.h"
#include "unity.h"

static const float PI = 3.14159265f;

enum { MOST = 8 };
static struct material materials[MOST];
static struct object objects[MOST];
static struct light lamp;
static struct scene scene;

static struct material white_wall(void)
{
    struct material m = {.kind = MATERIAL_DIFFUSE, .two_sided = true};
    return m;
}

/* Lets light pass straight on, times a colour. */
static struct material clear(rgb color)
{
    struct material m = {.kind = MATERIAL_GLASS, .eta = 1.0f};
    m.transmittance = m.reflectance = color;
    return m;
}

/* A square across the camera's way, facing it. */
static struct object *add(float z, struct material material)
{
    const float rows[16] = {4, 0, 0, 0, 0, 4, 0, 0, 0, 0, 1, z, 0, 0, 0, 1};
    struct transform place;
    uint32_t i = scene.object_count++;
    TEST_ASSERT_TRUE(i < MOST && transform_from_rows(rows, &place));
    materials[i] = material;
    objects[i].kind = OBJECT_RECT;
    objects[i].rect = rect_make(&place);
    objects[i].material = &materials[i];
    objects[i].light = -1;
    return &objects[i];
}

/* On a white wall at a distance of 2, straight on: 1 / pi times the irradiance
 * flux / (4 pi 2^2). */
void setUp(void)
{
    memset(objects, 0, sizeof objects);
    memset(&scene, 0, sizeof scene);
    memset(&lamp, 0, sizeof lamp);
    lamp.kind = LIGHT_POINT;
    lamp.position = vec3_make(0, 0, 2);
    lamp.flux = rgb_grey(16.0f * PI * PI);
    scene.objects = objects;
    scene.lights = &lamp;
    scene.light_count = 1;
    scene.environment = -1;
    scene.integrator.max_depth = 16;
}

void tearDown(void)
{
}

/* What the camera sees, straight down. */
static rgb look(void)
{
    static const struct ray_differential none;
    struct error error = {{0}};
    struct sampler sampler = sampler_start(SAMPLER_INDEPENDENT, 1, 0, 0, 1);
    struct tracer tracer = {&scene, &sampler, NULL};
    TEST_ASSERT_TRUE(scene_prepare(&scene, ACCEL_LINEAR, &error));
    rgb seen = intersection_test_radiance(
        &tracer,
        ray_make(vec3_make(0, 0, 10), vec3_make(0, 0, -1), 0.0f, INFINITY),
        none);
    accel_free(&scene.accel);
    mem_free(scene.primitives);
    mem_free(scene.first_primitive);
    light_table_free(&scene.light_table);
    return seen;
}

static void expect_seen(rgb want, const char *why)
{
    rgb got = look();
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(1e-5f, want.r, got.r, why);
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(1e-5f, want.g, got.g, why);
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(1e-5f, want.b, got.b, why);
}

static const rgb BLACK = {0.0f, 0.0f, 0.0f};
static const rgb WHITE = {1.0f, 1.0f, 1.0f};

static void a_wall_is_lit(void)
{
    add(0, white_wall());
    expect_seen(WHITE, "nothing between camera and wall: the wall's light");
}

static void outside_of_everything_is_black(void)
{
    expect_seen(BLACK, "the ray meets nothing: black");
}

static void behind_a_clear_pane_nothing_is_black(void)
{
    add(5, clear(WHITE));
    expect_seen(BLACK, "the ray passes a pane and then meets nothing: black");
}

static void what_has_no_material_is_black(void)
{
    add(0, white_wall());
    add(5, clear(WHITE))->material = NULL;
    expect_seen(BLACK, "an object without a material hides the wall: black");
}

static void a_clear_pane_does_not_hide_the_wall(void)
{
    add(0, white_wall());
    add(5, clear(WHITE));
    expect_seen(WHITE, "one clear pane: the wall behind it");
}

static void three_clear_panes_do_not_hide_the_wall(void)
{
    add(0, white_wall());
    for (int i = 0; i < 3; i++)
        add(4.0f + (float)i, clear(WHITE));
    expect_seen(WHITE, "three clear panes: the wall behind them");
}

static void a_coloured_pane_colours_the_wall(void)
{
    add(0, white_wall());
    add(5, clear(rgb_make(1.0f, 0.5f, 0.25f)));
    expect_seen(rgb_make(1.0f, 0.5f, 0.25f),
                "the wall's light times what the pane lets through");
}

static void max_depth_is_how_many_clear_surfaces_are_passed(void)
{
    add(0, white_wall());
    for (int i = 0; i < 3; i++)
        add(4.0f + (float)i, clear(WHITE));
    scene.integrator.max_depth = 2;
    expect_seen(BLACK, "three panes, max_depth 2: the third is one too many");
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(a_wall_is_lit);
    RUN_TEST(outside_of_everything_is_black);
    RUN_TEST(behind_a_clear_pane_nothing_is_black);
    RUN_TEST(what_has_no_material_is_black);
    RUN_TEST(a_clear_pane_does_not_hide_the_wall);
    RUN_TEST(three_clear_panes_do_not_hide_the_wall);
    RUN_TEST(a_coloured_pane_colours_the_wall);
    RUN_TEST(max_depth_is_how_many_clear_surfaces_are_passed);
    return UNITY_END();
}
