/* test_several_lights.c - the public tests of assignment 07.
 *
 * The first half asks the table of lights alone. The second puts lamps of
 * different colours over a grey floor (10 by 10, y = 0) that is seen from
 * above; nothing is in their way.
 *
 * Read a test's name and its message; the contracts are in lights/selection.h
 * and integrators/several_lights.h. */
#include "integrators/several_lights.h"

#include "base/constants.h"
#include "base/memory.h"
#include "integrators/delta_lighting.h"
#include "unity.h"

enum { LAMPS = 4, STEPS = 1 << 16 };

static struct light lamps[LAMPS];
static struct scene scene;
static struct texture paint = {.kind = TEXTURE_CONSTANT,
                               .color = {{0.5f, 0.5f, 0.5f}, {0, 0, 0}}};
static struct material grey = {.kind = MATERIAL_DIFFUSE, .albedo = &paint};
static struct sampler sampler;
static struct tracer tracer;
static struct vertex middle;

/* Of grey flux, in W: its power is the same number. */
static struct light lamp(float flux)
{
    struct light light = {.kind = LIGHT_POINT,
                          .position = {0.0f, 2.0f, 0.0f},
                          .flux = {flux, flux, flux}};
    return light;
}

void setUp(void)
{
    static const float fluxes[LAMPS] = {10.0f, 0.0f, 30.0f, 60.0f};
    for (int i = 0; i < LAMPS; i++)
        lamps[i] = lamp(fluxes[i]);
}

/* The lamps are not the scene's own. */
void tearDown(void)
{
    struct scene empty = {.environment = -1};
    scene.lights = NULL;
    scene.light_count = 0;
    scene_free(&scene);
    scene = empty;
}

/* --- The table ------------------------------------------------------------ */

static void expect_probability(const struct light_table *t, uint32_t light,
                               float want, const char *why)
{
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(1e-4f * want, want,
                                     light_table_probability(t, light), why);
}

static void evenly_all_are_as_likely(void)
{
    struct light_table t = light_table_make(lamps, LAMPS, false, 5.0f);
    for (uint32_t i = 0; i < LAMPS; i++)
        expect_probability(&t, i, 0.25f, "four lights, a quarter each");
    light_table_free(&t);
}

static void by_power_twice_as_strong_is_twice_as_likely(void)
{
    struct light_table t = light_table_make(lamps, LAMPS, true, 5.0f);
    expect_probability(&t, 0, 0.1f, "10 W of 100 W");
    expect_probability(&t, 1, 0.0f, "a light without power is never picked");
    expect_probability(&t, 2, 0.3f, "30 W of 100 W");
    expect_probability(&t, 3, 0.6f, "60 W of 100 W");
    light_table_free(&t);
}

static void a_faint_light_is_not_forgotten(void)
{
    struct light few[2] = {lamp(1.0f), lamp(1e-9f)};
    struct light_table t = light_table_make(few, 2, true, 5.0f);
    TEST_ASSERT_TRUE_MESSAGE(light_table_probability(&t, 1) > 4e-4f,
                             "a thousandth of the mean weight, 0.5, at least");
    light_table_free(&t);
}

static void without_any_power_all_are_as_likely(void)
{
    struct light dark[2] = {lamp(0.0f), lamp(0.0f)};
    struct light_table t = light_table_make(dark, 2, true, 5.0f);
    expect_probability(&t, 0, 0.5f, "none has power: each is as likely");
    expect_probability(&t, 1, 0.5f, "none has power: each is as likely");
    light_table_free(&t);
}

static void picks_are_as_frequent_as_their_probability(void)
{
    int picks[LAMPS] = {0};
    struct light_table t = light_table_make(lamps, LAMPS, true, 5.0f);
    for (int i = 0; i < STEPS; i++) {
        float likely;
        uint32_t light = light_table_pick(&t, (float)i / (float)STEPS, &likely);
        TEST_ASSERT_TRUE_MESSAGE(light < LAMPS, "an index below the count");
        TEST_ASSERT_TRUE_MESSAGE(likely > 0.0f, "never one of 0");
        TEST_ASSERT_FLOAT_WITHIN_MESSAGE(
            1e-5f, light_table_probability(&t, light), likely,
            "the same probability by both ways");
        picks[light]++;
    }
    TEST_ASSERT_INT_WITHIN_MESSAGE(STEPS / 100, STEPS / 10, picks[0],
                                   "a tenth of even numbers pick light 0");
    TEST_ASSERT_INT_WITHIN_MESSAGE(STEPS / 100, STEPS * 6 / 10, picks[3],
                                   "six tenths of them pick light 3");
    light_table_free(&t);
}

static void no_light_makes_an_empty_table(void)
{
    struct light_table t = light_table_make(NULL, 0, true, 5.0f);
    TEST_ASSERT_EQUAL_UINT32_MESSAGE(0, t.count, "the count is the lights'");
    light_table_free(&t);
    light_table_free(&t);
    TEST_ASSERT_NULL_MESSAGE(t.choices, "nothing is left, so that a second "
                                        "light_table_free does no harm");
}

/* --- The light of several ------------------------------------------------- */

/* albedo / pi x flux / (4 pi d^2), straight from above at 2 m */
static float from_above(float flux)
{
    return 0.5f / PI * flux / (4.0f * PI * 4.0f);
}

/* What is summed here is the exercise of assignment 05. */
static void wait_for_direct_light(void)
{
    rgb all = delta_lighting(&tracer, &middle);
    if (fabsf(all.r - from_above(100.0f)) > 0.01f * all.r)
        TEST_IGNORE_MESSAGE("waits for assignment 05: lights that fade");
}

/* The floor's middle under the lamps. */
static struct asking ask_from_the_floor(void)
{
    struct ray_differential none = {0};
    struct error err;
    scene.objects = mem_alloc(1, sizeof *scene.objects);
    scene.object_count = 1;
    struct object *o = scene.objects;
    o->kind = OBJECT_RECT;
    o->material = &grey;
    o->light = -1;
    o->rect.side_x = vec3_make(10, 0, 0);
    o->rect.side_y = vec3_make(0, 0, -10);
    o->rect.normal = vec3_make(0, 1, 0);
    TEST_ASSERT_TRUE(scene_prepare(&scene, ACCEL_LINEAR, &err));
    scene.lights = lamps;
    scene.light_count = LAMPS;
    sampler = sampler_start(SAMPLER_INDEPENDENT, 1, 0, 0, 1);
    tracer.scene = &scene;
    tracer.sampler = &sampler;
    ray down = ray_make(vec3_make(0, 3, 0), vec3_make(0, -1, 0), 0, INFINITY);
    TEST_ASSERT_TRUE(tracer_hit(&tracer, &down, &none, &middle));
    struct asking a = {&tracer, &middle, false};
    wait_for_direct_light();
    return a;
}

static void expect(rgb want, rgb got, float share, const char *why)
{
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(share * want.r, want.r, got.r, why);
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(share * want.g, want.g, got.g, why);
    TEST_ASSERT_FLOAT_WITHIN_MESSAGE(share * want.b, want.b, got.b, why);
}

static void the_light_of_all_is_their_sum(void)
{
    struct asking a = ask_from_the_floor();
    lamps[0].flux = rgb_make(8.0f, 0.0f, 1.0f);
    lamps[2].flux = rgb_make(2.0f, 5.0f, 1.0f);
    lamps[3].flux = rgb_make(0.0f, 1.0f, 7.0f);
    rgb want = rgb_make(from_above(10.0f), from_above(6.0f), from_above(9.0f));
    expect(want, all_lights(&a, LAMPS), 1e-4f, "red, green and blue add up");
    expect(want, all_lights(&a, LAMPS), 1e-4f, "the second time as well");
}

static void only_the_first_count_lights_are_asked(void)
{
    struct asking a = ask_from_the_floor();
    expect(rgb_grey(from_above(10.0f)), all_lights(&a, 1), 1e-4f,
           "one light is asked for: the first");
    expect(rgb_grey(from_above(40.0f)), all_lights(&a, 3), 1e-4f,
           "three lights are asked for");
    expect(rgb_grey(0.0f), all_lights(&a, 0), 1e-4f, "no light, no radiance");
}

static void one_stands_for_all(void)
{
    struct asking a = ask_from_the_floor();
    lamps[0].flux = rgb_make(60.0f, 0.0f, 0.0f);
    for (int by_power = 0; by_power < 2; by_power++) {
        struct light_table t =
            light_table_make(lamps, LAMPS, by_power == 1, 5.0f);
        rgb sum = rgb_grey(0.0f);
        for (int i = 0; i < 4096; i++) {
            float random = ((float)i + 0.5f) / 4096.0f;
            sum = rgb_add(sum, one_light(&a, &t, random));
        }
        rgb want =
            rgb_make(from_above(150.0f), from_above(90.0f), from_above(90.0f));
        expect(want, rgb_scale(sum, 1.0f / 4096.0f), 0.01f,
               "averaged over all random numbers it is the light of all");
        light_table_free(&t);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(evenly_all_are_as_likely);
    RUN_TEST(by_power_twice_as_strong_is_twice_as_likely);
    RUN_TEST(a_faint_light_is_not_forgotten);
    RUN_TEST(without_any_power_all_are_as_likely);
    RUN_TEST(picks_are_as_frequent_as_their_probability);
    RUN_TEST(no_light_makes_an_empty_table);
    RUN_TEST(the_light_of_all_is_their_sum);
    RUN_TEST(only_the_first_count_lights_are_asked);
    RUN_TEST(one_stands_for_all);
    return UNITY_END();
}
