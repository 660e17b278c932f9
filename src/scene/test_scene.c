/* test_scene.c - tests of load.h and scene.h: from a file to what is hit. */
#define _POSIX_C_SOURCE 200809L

#include "scene/scene.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "sampling/sampler.h"
#include "scene/load.h"

#include "unity.h"

static char scene_path[] = "/tmp/raybook-scene-XXXXXX";
static char mesh_path[] = "/tmp/raybook-mesh-XXXXXX";
static struct scene scene;
static struct error fault;

void setUp(void)
{
    fault.text[0] = '\0';
    memset(&scene, 0, sizeof scene);
}

void tearDown(void)
{
    scene_free(&scene);
}

static void write_file(const char *path, const char *text)
{
    FILE *f = fopen(path, "w");
    TEST_ASSERT_NOT_NULL(f);
    fputs(text, f);
    fclose(f);
}

static void load(const char *text, const char *override)
{
    write_file(scene_path, text);
    if (!scene_load(scene_path, override, &scene, &fault))
        TEST_FAIL_MESSAGE(fault.text);
}

/* The fault must hold the words. */
static void refuse(const char *text, const char *words)
{
    write_file(scene_path, text);
    fault.text[0] = '\0';
    scene_free(&scene);
    TEST_ASSERT_FALSE_MESSAGE(scene_load(scene_path, NULL, &scene, &fault),
                              text);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(fault.text, words), fault.text);
    scene_free(&scene);
    memset(&scene, 0, sizeof scene);
}

#define PAINT                                                                  \
    "\"textures\": {\"t\": {\"type\": \"constant\", \"color\": [1,0.5,0]}},"   \
    "\"materials\": {\"m\": {\"type\": \"diffuse\", \"texture_name\": \"t\"}}"

#define BALL(x, y, z, radius)                                                  \
    "{\"type\": \"sphere\", \"center\": [" #x "," #y "," #z                    \
    "], \"radius\": " #radius ", \"material_name\": \"m\"}"

static void a_scene_without_settings_has_the_defaults(void)
{
    load("{" PAINT ", \"objects\": [" BALL(0, 0, 0, 1) "]}", NULL);
    TEST_ASSERT_EQUAL_INT(600, scene.film.width);
    TEST_ASSERT_EQUAL_INT(600, scene.film.height);
    TEST_ASSERT_EQUAL_FLOAT(0.5f, scene.film.filter_radius);
    TEST_ASSERT_EQUAL_FLOAT(1, scene.camera.position.z);
    TEST_ASSERT_EQUAL_FLOAT(1, scene.camera.up.y);
    TEST_ASSERT_EQUAL_FLOAT(45, scene.camera.vertical_fov);
    TEST_ASSERT_EQUAL_INT(8, scene.integrator.spp);
    TEST_ASSERT_EQUAL_INT(16, scene.integrator.max_depth);
    TEST_ASSERT_EQUAL_UINT32(1, scene.light_count);
    TEST_ASSERT_EQUAL_FLOAT(5, scene.lights[0].position.y);
    TEST_ASSERT_EQUAL_FLOAT(1, scene.lights[0].flux.g);
}

static void settings_are_read(void)
{
    load("{" PAINT ", \"objects\": [" BALL(
             0, 0, 0,
             1) "], \"integrator\": {\"type\": \"intersection_test\", \"spp\": "
                "3,"
                " \"point_light_position\": [1,2,3], \"point_light_flux\": "
                "[4,5,6]},"
                " \"film\": {\"resolution\": [20, 10], \"filter\": "
                "{\"radius\": 1}},"
                " \"camera\": {\"position\": [7,8,9], \"fov\": 30},"
                " \"sampler\": {\"seed\": 9007199254740992},"
                " \"lights\": [{\"type\": \"point\", \"position\": [1,1,1],"
                " \"flux\": [9,9,9]}]}",
         NULL);
    TEST_ASSERT_EQUAL_INT(3, scene.integrator.spp);
    TEST_ASSERT_EQUAL_INT(20, scene.film.width);
    TEST_ASSERT_EQUAL_INT(10, scene.film.height);
    TEST_ASSERT_EQUAL_FLOAT(1, scene.film.filter_radius);
    TEST_ASSERT_EQUAL_FLOAT(8, scene.camera.position.y);
    TEST_ASSERT_EQUAL_FLOAT(30, scene.camera.vertical_fov);
    TEST_ASSERT_TRUE(scene.integrator.seed == UINT64_C(9007199254740992));
    TEST_ASSERT_EQUAL_UINT32(2, scene.light_count);
    TEST_ASSERT_EQUAL_FLOAT(3, scene.lights[0].position.z);
    TEST_ASSERT_EQUAL_FLOAT(5, scene.lights[0].flux.g);
    TEST_ASSERT_EQUAL_FLOAT(9, scene.lights[1].flux.b);
}

static void materials_and_textures_are_found_by_name(void)
{
    load("{" PAINT ", \"objects\": [" BALL(0, 0, 0, 2) "]}", NULL);
    TEST_ASSERT_EQUAL_UINT32(1, scene.object_count);
    const struct material *m = scene.objects[0].material;
    TEST_ASSERT_EQUAL_FLOAT(0.5f, m->albedo->color[0].g);
    TEST_ASSERT_FALSE(m->two_sided);
    TEST_ASSERT_EQUAL_FLOAT(2, scene.objects[0].sphere.radius);
}

/* RFC 7396. */
static void an_override_is_merged(void)
{
    load("{\"film\": {\"resolution\": [20, 10], \"filter\": {\"radius\": 2}},"
         " \"camera\": {\"fov\": 30}, " PAINT
         ", \"objects\": [" BALL(0, 0, 0, 1) "," BALL(5, 0, 0, 1) "]}",
         "{\"film\": {\"resolution\": [6, 7]}, \"camera\": null,"
         " \"objects\": [" BALL(1, 2, 3, 4) "]}");
    TEST_ASSERT_EQUAL_INT(6, scene.film.width);
    TEST_ASSERT_EQUAL_FLOAT_MESSAGE(2, scene.film.filter_radius, "merged");
    TEST_ASSERT_EQUAL_FLOAT_MESSAGE(45, scene.camera.vertical_fov, "removed");
    TEST_ASSERT_EQUAL_UINT32_MESSAGE(1, scene.object_count, "replaced");
    TEST_ASSERT_EQUAL_FLOAT(4, scene.objects[0].sphere.radius);
}

static void faults_name_their_place(void)
{
    refuse("{\"film\": {\"resolution\": [0, 10]}}", ": /film/resolution/0: ");
    refuse("{\"film\": {\"resolution\": [65536, 65536]}}",
           ": /film/resolution: 65536 x 65536 pixels are too many");
    refuse("{\"camra\": {}}", "did you mean \"camera\"?");
    refuse("{\"camera\": {\"position\": [1,1,1], \"look_at\": [1,1,1]}}",
           "/camera: position and look_at are the same point");
    refuse("{\"camera\": {\"ref_up\": [0, 0, 2]}}",
           "/camera: ref_up is parallel");
    refuse("{\"integrator\": {\"spp\": 0}}", "/integrator/spp");
    refuse("{" PAINT ", \"objects\": [{\"type\": \"sphere\", \"center\": "
           "[0,0,0], \"radius\": 1, \"material_name\": \"n\"}]}",
           "/objects/0/material_name: unknown material \"n\"");
    refuse("{" PAINT ", \"objects\": [" BALL(0, 0, 0, 0) "]}",
           "/objects/0/radius: found the number 0, expected a number above 0");
    refuse("{" PAINT ", \"objects\": [{\"type\": \"mesh\", \"path\": "
           "\"no-such.obj\", \"material_name\": \"m\"}]}",
           "/objects/0/path: /tmp/no-such.obj: cannot read");
    refuse("{}", "there are no objects");
    refuse("[]", "the whole file: found a list of 0, expected an object");
}

static void an_albedo_above_one_is_a_fault(void)
{
    refuse("{\"textures\": {\"t\": {\"type\": \"constant\", \"color\": "
           "[1.01,0,0]}}, \"materials\": {\"m\": {\"type\": \"diffuse\", "
           "\"texture_name\": \"t\"}}}",
           "expected at most 1");
}

/* Loads the text again with the structure, and builds it. */
static void prepare(const char *text, enum accel_kind kind)
{
    scene_free(&scene);
    load(text, NULL);
    TEST_ASSERT_TRUE(scene_prepare(&scene, kind, &fault));
}

static struct scene_hit nearest(vec3 from, vec3 to)
{
    struct scene_hit hit = {UINT32_MAX, -7, 0, 0};
    ray r = ray_make(from, vec3_sub(to, from), 0, INFINITY);
    TEST_ASSERT_TRUE(scene_nearest(&scene, &r, &hit));
    return hit;
}

static void the_nearest_object_is_hit_with_its_material(void)
{
    prepare("{" PAINT
            ", \"objects\": [" BALL(0, 0, 0, 1) "," BALL(0, 0, 3, 1) "]}",
            ACCEL_BVH);
    struct scene_hit hit = nearest(vec3_make(0, 0, 10), vec3_make(0, 0, 9));
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 6, hit.t);
    const struct object *o = scene_object(&scene, &hit);
    ray r = ray_make(vec3_make(0, 0, 10), vec3_make(0, 0, -1), 0, INFINITY);
    struct surface s;
    scene_surface(&scene, &r, &hit, o, &s);
    TEST_ASSERT_EQUAL_PTR(scene.objects + 1, o);
    TEST_ASSERT_EQUAL_PTR(scene.materials, o->material);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 4, s.position.z);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 1, s.geometric_normal.z);
}

/* A file must have objects; the queries need none. */
static void an_empty_scene_is_missed(void)
{
    for (int kind = ACCEL_WIDE; kind <= ACCEL_LINEAR; kind++) {
        struct scene_hit hit;
        ray r = ray_make(vec3_make(0, 0, 0), vec3_make(0, 0, 1), 0, INFINITY);
        scene_free(&scene);
        memset(&scene, 0, sizeof scene);
        TEST_ASSERT_TRUE(scene_prepare(&scene, (enum accel_kind)kind, &fault));
        TEST_ASSERT_FALSE(scene_nearest(&scene, &r, &hit));
    }
}

/* The floor at y = 0, a ball above it; is (x, 0, 0) in the dark? */
static bool shadowed(float x, vec3 light)
{
    struct scene_hit hit = nearest(vec3_make(x, 0.25f, 0), vec3_make(x, 0, 0));
    const struct object *o = scene_object(&scene, &hit);
    ray r =
        ray_make(vec3_make(x, 0.25f, 0), vec3_make(0, -0.25f, 0), 0, INFINITY);
    struct surface s;
    scene_surface(&scene, &r, &hit, o, &s);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0, s.position.y);
    return scene_segment_blocked(&scene, &s, light);
}

/* Light at (0, 6, 0), ball of radius 1 at (0, 2, 0): the tangent from the
 * light has sin a = 1/4, so the shadow ends at x = 6 tan a = 6 / sqrt(15). */
static void shadows_end_where_geometry_says(void)
{
    char text[1000];
    float rim = 6.0f / sqrtf(15.0f);
    vec3 light = vec3_make(0, 6, 0);
    write_file(mesh_path,
               "v -9 0 9\nv 9 0 9\nv 9 0 -9\nv -9 0 -9\nf 1 2 3 4\n");
    sprintf(text,
            "{" PAINT ", \"objects\": [" BALL(
                0, 2, 0, 1) ", {\"type\": \"mesh"
                            "\", \"path\": \"%s\", \"material_name\": \"m\"}]}",
            mesh_path);
    prepare(text, ACCEL_BVH);
    TEST_ASSERT_TRUE(shadowed(0, light));
    TEST_ASSERT_TRUE(shadowed(rim - 1e-4f, light));
    TEST_ASSERT_FALSE(shadowed(rim + 1e-4f, light));
    TEST_ASSERT_TRUE(shadowed(-rim + 1e-4f, light));
    TEST_ASSERT_FALSE_MESSAGE(shadowed(0, vec3_make(0, 0.9f, 0)),
                              "the ball is behind the light");
    TEST_ASSERT_TRUE_MESSAGE(shadowed(0, vec3_make(0, 2, 0)),
                             "the light is inside the ball");
}

enum { BALLS = 300, RAYS = 3000 };

static void write_balls(char *text)
{
    text += sprintf(text, "{" PAINT ", \"objects\": [");
    for (uint64_t i = 0; i < BALLS; i++) {
        struct sampler s = sampler_start(SAMPLER_INDEPENDENT, 0, 0, i, 1);
        vec2 xy = sampler_2d(&s);
        text += sprintf(text,
                        "%s{\"type\": \"sphere\", \"center\": [%f, %f, %f], "
                        "\"radius\": 0.05, \"material_name\": \"m\"}",
                        i > 0 ? "," : "", (double)xy.x, (double)xy.y,
                        (double)sampler_1d(&s));
    }
    strcpy(text, "]}");
}

static ray ball_ray(uint64_t i)
{
    struct sampler s = sampler_start(SAMPLER_INDEPENDENT, 1, 0, i, 1);
    vec2 a = sampler_2d(&s), b = sampler_2d(&s);
    vec3 from = vec3_make(2 * a.x - 0.5f, 2 * a.y - 0.5f, -1);
    vec3 d = vec3_sub(vec3_make(b.x, b.y, sampler_1d(&s)), from);
    return ray_make(from, d, 0, INFINITY);
}

/* The same t to the last bit: what prunes may not change what is found. */
static void trees_find_what_testing_everything_finds(void)
{
    static float t[3][RAYS];
    char *text = malloc(BALLS * 200);
    write_balls(text);
    int hits = 0;
    for (int kind = ACCEL_WIDE; kind <= ACCEL_LINEAR; kind++) {
        prepare(text, (enum accel_kind)kind);
        for (uint64_t i = 0; i < RAYS; i++) {
            struct scene_hit hit = {0, -1, 0, 0};
            ray r = ball_ray(i);
            hits += scene_nearest(&scene, &r, &hit);
            t[kind][i] = hit.t;
        }
    }
    free(text);
    TEST_ASSERT_TRUE(hits > RAYS / 2);
    TEST_ASSERT_EQUAL_MEMORY(t[ACCEL_LINEAR], t[ACCEL_BVH], sizeof t[0]);
    TEST_ASSERT_EQUAL_MEMORY(t[ACCEL_LINEAR], t[ACCEL_WIDE], sizeof t[0]);
}

int main(void)
{
    int a = mkstemp(scene_path), b = mkstemp(mesh_path);
    if (a < 0 || b < 0)
        return 1;
    close(a);
    close(b);
    UNITY_BEGIN();
    RUN_TEST(a_scene_without_settings_has_the_defaults);
    RUN_TEST(settings_are_read);
    RUN_TEST(materials_and_textures_are_found_by_name);
    RUN_TEST(an_override_is_merged);
    RUN_TEST(faults_name_their_place);
    RUN_TEST(an_albedo_above_one_is_a_fault);
    RUN_TEST(the_nearest_object_is_hit_with_its_material);
    RUN_TEST(an_empty_scene_is_missed);
    RUN_TEST(shadows_end_where_geometry_says);
    RUN_TEST(trees_find_what_testing_everything_finds);
    unlink(scene_path);
    unlink(mesh_path);
    return UNITY_END();
}
