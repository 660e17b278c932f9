/* probe_direct.c - runs a direct-lighting module on many cases; judges nothing.
 *
 *   probe INPUT OUTPUT GROUP
 *
 * Both files are arrays of records of 32-bit little-endian words (f = IEEE
 * single, u = unsigned); OUTPUT has one record for each of INPUT, in order.
 * oracle_fading.py and oracle_direct.py mirror this layout.
 *
 * GROUP "fading":
 *   in    4     3 f flux, f distance
 *   out   3     3 f irradiance
 * Any other GROUP:
 *   in   66     material: u kind, 3 f albedo, f alpha, 3 f eta, 3 f k;
 *               ray that finds the vertex: 3 f origin, 3 f direction;
 *               3 f shading normal (0 0 0: the surface's own);
 *               light sample: 3 f direction, 3 f target, u infinite, u delta,
 *               3 f radiance, f pdf;
 *               u number of objects, then OBJECTS_MAX objects: u shape (enum
 *               object_kind), u material (0 the one above, 1 glass, 2 none),
 *               9 f shape: sphere: centre, radius; rect: centre, two sides
 *   out   5     3 f radiance, u flags, u index of the object that the ray met
 * Flags: 1 = changed the vertex; 2 = changed the light sample; 4 = the ray met
 * nothing: the oracle's fault. */
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "integrators/direct_lighting.h"
#include "lights/point_light.h"

enum { CHANGED_VERTEX = 1, CHANGED_SAMPLE = 2, NO_VERTEX = 4 };
enum { FADING_IN = 4, FADING_OUT = 3 };
enum { OBJECTS_MAX = 3, DIRECT_IN = 33 + 11 * OBJECTS_MAX, DIRECT_OUT = 5 };

/* A record, and how far it has been read. */
struct words {
    const uint32_t *next;
};

typedef void run_case(struct words in, uint32_t *out);

static void fail(const char *file, const char *what)
{
    fprintf(stderr, "probe_direct: %s: %s\n", file, what);
    exit(2);
}

static uint32_t take(struct words *in)
{
    return *in->next++;
}

static float take_float(struct words *in)
{
    uint32_t word = take(in);
    float value;
    memcpy(&value, &word, sizeof value);
    return value;
}

static vec3 take_vec3(struct words *in)
{
    float x = take_float(in), y = take_float(in), z = take_float(in);
    return vec3_make(x, y, z);
}

static rgb take_rgb(struct words *in)
{
    vec3 v = take_vec3(in);
    return rgb_make(v.x, v.y, v.z);
}

static void put_rgb(uint32_t *out, rgb c)
{
    const float values[3] = {c.r, c.g, c.b};
    memcpy(out, values, sizeof values);
}

static void run_fading(struct words in, uint32_t *out)
{
    rgb flux = take_rgb(&in);
    put_rgb(out, point_light_irradiance(flux, take_float(&in)));
}

static struct material take_material(struct words *in, struct texture *paint)
{
    struct material m = {.albedo = paint};
    uint32_t kind = take(in);
    m.kind = kind == 2 ? MATERIAL_ROUGH_CONDUCTOR : MATERIAL_DIFFUSE;
    m.two_sided = kind == 1;
    paint->color[0] = take_rgb(in);
    m.alpha_x = m.alpha_y = take_float(in);
    m.conductor_eta = take_rgb(in);
    m.conductor_k = take_rgb(in);
    return m;
}

static struct rect take_rect(struct words *in)
{
    struct rect r;
    r.center = take_vec3(in);
    r.side_x = take_vec3(in);
    r.side_y = take_vec3(in);
    vec3 normal = vec3_cross(r.side_x, r.side_y);
    r.area = vec3_length(normal);
    r.normal = vec3_normalize(normal);
    return r;
}

static struct object take_object(struct words *in,
                                 const struct material materials[2])
{
    struct object o = {.light = -1};
    o.kind = (enum object_kind)take(in);
    uint32_t material = take(in);
    o.material = material < 2 ? &materials[material] : NULL;
    struct words shape = *in;
    in->next += 9;
    if (o.kind == OBJECT_RECT) {
        o.rect = take_rect(&shape);
    } else {
        o.sphere.center = take_vec3(&shape);
        o.sphere.radius = take_float(&shape);
    }
    return o;
}

static struct light_sample take_sample(struct words *in)
{
    struct light_sample s;
    s.direction = take_vec3(in);
    s.target = take_vec3(in);
    s.infinite = take(in) != 0;
    s.delta = take(in) != 0;
    s.radiance = take_rgb(in);
    s.pdf = take_float(in);
    return s;
}

/* The scene's own lights are elsewhere: only the sample counts. */
static struct scene take_scene(struct words *in,
                               const struct material materials[2])
{
    struct scene scene = {.environment = -1, .light_count = 2};
    scene.lights = mem_alloc(2, sizeof *scene.lights);
    scene.lights[0].position = vec3_make(-7.0f, 11.0f, 5.0f);
    scene.lights[1].position = vec3_make(3.0f, -13.0f, 2.0f);
    scene.object_count = take(in);
    scene.objects = mem_alloc(OBJECTS_MAX, sizeof *scene.objects);
    for (int i = 0; i < OBJECTS_MAX; i++)
        scene.objects[i] = take_object(in, materials);
    return scene;
}

static void light_vertex(const struct scene *scene, struct vertex *v,
                         struct light_sample *s, uint32_t *out)
{
    struct vertex vertex_before;
    struct light_sample sample_before;
    memcpy(&vertex_before, v, sizeof *v);
    memcpy(&sample_before, s, sizeof *s);
    put_rgb(out, direct_light(scene, v, s));
    if (memcmp(&vertex_before, v, sizeof *v) != 0)
        out[3] |= CHANGED_VERTEX;
    if (memcmp(&sample_before, s, sizeof *s) != 0)
        out[3] |= CHANGED_SAMPLE;
    out[4] = (uint32_t)(vertex_before.object - scene->objects);
}

static void run_direct(struct words in, uint32_t *out)
{
    struct texture paint = {.kind = TEXTURE_CONSTANT};
    struct material materials[2] = {{0},
                                    {.kind = MATERIAL_REFRACTION, .eta = 1.5f}};
    materials[0] = take_material(&in, &paint);
    vec3 origin = take_vec3(&in), direction = take_vec3(&in);
    vec3 normal = take_vec3(&in);
    struct light_sample s = take_sample(&in);
    struct scene scene = take_scene(&in, materials);
    struct error err = {{0}};
    if (!scene_prepare(&scene, ACCEL_BVH, &err))
        fail("scene", err.text);

    struct tracer t = {&scene, NULL, NULL};
    struct ray_differential none;
    struct vertex v;
    memset(&none, 0, sizeof none);
    ray r = ray_make(origin, direction, 0.0f, INFINITY);
    if (tracer_hit(&t, &r, &none, &v)) {
        if (vec3_dot(normal, normal) > 0.0f)
            v.surface.shading_normal = normal;
        light_vertex(&scene, &v, &s, out);
    } else {
        out[3] = NO_VERTEX;
    }
    scene_free(&scene);
}

/* The next record of `words` words; false at the end of the file. */
static bool read_record(FILE *file, const char *name, uint32_t *record,
                        size_t words)
{
    unsigned char bytes[4 * DIRECT_IN];
    size_t got = fread(bytes, 1, 4 * words, file);
    if (ferror(file))
        fail(name, "cannot be read");
    if (got == 0)
        return false;
    if (got != 4 * words)
        fail(name, "ends inside a record; expected whole records of cases");
    for (size_t i = 0; i < words; i++) {
        const unsigned char *b = bytes + 4 * i;
        record[i] = (uint32_t)b[0] | (uint32_t)b[1] << 8 |
                    (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
    }
    return true;
}

static void write_record(FILE *file, const char *name, const uint32_t *record,
                         size_t words)
{
    unsigned char bytes[4 * DIRECT_OUT];
    for (size_t i = 0; i < 4 * words; i++)
        bytes[i] = (unsigned char)(record[i / 4] >> (8 * (i % 4)));
    if (fwrite(bytes, 1, 4 * words, file) != 4 * words)
        fail(name, "cannot be written");
}

static FILE *open_or_fail(const char *name, const char *mode)
{
    FILE *file = fopen(name, mode);
    if (!file)
        fail(name, "cannot be opened");
    return file;
}

int main(int argc, char **argv)
{
    if (argc != 4) {
        fprintf(stderr, "usage: probe_direct INPUT OUTPUT GROUP\n");
        return 2;
    }
    bool fading = strcmp(argv[3], "fading") == 0;
    run_case *run = fading ? run_fading : run_direct;
    size_t words_in = fading ? FADING_IN : DIRECT_IN;
    size_t words_out = fading ? FADING_OUT : DIRECT_OUT;

    FILE *input = open_or_fail(argv[1], "rb");
    FILE *output = open_or_fail(argv[2], "wb");
    uint32_t in[DIRECT_IN];
    while (read_record(input, argv[1], in, words_in)) {
        uint32_t out[DIRECT_OUT] = {0};
        struct words words = {in};
        run(words, out);
        write_record(output, argv[2], out, words_out);
    }
    if (fclose(output) != 0)
        fail(argv[2], "cannot be written");
    fclose(input);
    return 0;
}
