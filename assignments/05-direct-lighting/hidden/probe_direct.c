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
#include "base/memory.h"
#include "integrators/direct_lighting.h"
#include "lights/point_light.h"
#include "probe.h"

enum { CHANGED_VERTEX = 1, CHANGED_SAMPLE = 2, NO_VERTEX = 4 };
enum { OBJECTS_MAX = 3 };

struct answer {
    rgb radiance;
    uint32_t flags, object;
};

static void run_fading(struct probe *p)
{
    rgb flux = take_rgb(p);
    put_rgb(p, point_light_irradiance(flux, take_float(p)));
}

static struct material take_material(struct probe *p, struct texture *paint)
{
    struct material m = {.albedo = paint};
    uint32_t kind = take_word(p);
    m.kind = kind == 2 ? MATERIAL_ROUGH_CONDUCTOR : MATERIAL_DIFFUSE;
    m.two_sided = kind == 1;
    paint->color[0] = take_rgb(p);
    m.alpha_x = m.alpha_y = take_float(p);
    m.conductor_eta = take_rgb(p);
    m.conductor_k = take_rgb(p);
    return m;
}

static struct rect rect_of(vec3 center, vec3 side_x, vec3 side_y)
{
    vec3 normal = vec3_cross(side_x, side_y);
    struct rect r = {center, side_x, side_y, vec3_normalize(normal),
                     vec3_length(normal)};
    return r;
}

static struct object take_object(struct probe *p,
                                 const struct material materials[2])
{
    struct object o = {.light = -1};
    o.kind = (enum object_kind)take_word(p);
    uint32_t material = take_word(p);
    o.material = material < 2 ? &materials[material] : NULL;
    vec3 center = take_vec3(p), second = take_vec3(p), third = take_vec3(p);
    if (o.kind == OBJECT_RECT) {
        o.rect = rect_of(center, second, third);
    } else {
        o.sphere.center = center;
        o.sphere.radius = second.x;
    }
    return o;
}

static struct light_sample take_sample(struct probe *p)
{
    struct light_sample s;
    s.direction = take_vec3(p);
    s.target = take_vec3(p);
    s.infinite = take_word(p) != 0;
    s.delta = take_word(p) != 0;
    s.radiance = take_rgb(p);
    s.pdf = take_float(p);
    return s;
}

/* The scene's own lights are elsewhere: only the sample counts. */
static struct scene take_scene(struct probe *p,
                               const struct material materials[2])
{
    struct scene scene = {.environment = -1, .light_count = 2};
    struct error err = {{0}};
    scene.lights = mem_alloc(2, sizeof *scene.lights);
    scene.lights[0].position = vec3_make(-7.0f, 11.0f, 5.0f);
    scene.lights[1].position = vec3_make(3.0f, -13.0f, 2.0f);
    scene.object_count = take_word(p);
    scene.objects = mem_alloc(OBJECTS_MAX, sizeof *scene.objects);
    for (int i = 0; i < OBJECTS_MAX; i++)
        scene.objects[i] = take_object(p, materials);
    if (!scene_prepare(&scene, ACCEL_BVH, &err))
        probe_fail(p, "scene", err.text);
    return scene;
}

static struct answer light_vertex(const struct scene *scene, struct vertex *v,
                                  struct light_sample *s)
{
    struct vertex vertex_before;
    struct light_sample sample_before;
    memcpy(&vertex_before, v, sizeof *v);
    memcpy(&sample_before, s, sizeof *s);
    struct answer a = {.radiance = direct_light(scene, v, s)};
    if (memcmp(&vertex_before, v, sizeof *v) != 0)
        a.flags |= CHANGED_VERTEX;
    if (memcmp(&sample_before, s, sizeof *s) != 0)
        a.flags |= CHANGED_SAMPLE;
    a.object = (uint32_t)(vertex_before.object - scene->objects);
    return a;
}

static void put_answer(struct probe *p, struct answer a)
{
    put_rgb(p, a.radiance);
    put_word(p, a.flags);
    put_word(p, a.object);
}

static void run_direct(struct probe *p)
{
    struct texture paint = {.kind = TEXTURE_CONSTANT};
    struct material materials[2] = {{0},
                                    {.kind = MATERIAL_REFRACTION, .eta = 1.5f}};
    materials[0] = take_material(p, &paint);
    vec3 origin = take_vec3(p), direction = take_vec3(p);
    vec3 normal = take_vec3(p);
    struct light_sample s = take_sample(p);
    struct scene scene = take_scene(p, materials);

    struct tracer t = {&scene, NULL, NULL};
    struct answer a = {.flags = NO_VERTEX};
    struct ray_differential none;
    struct vertex v;
    memset(&none, 0, sizeof none);
    ray r = ray_make(origin, direction, 0.0f, INFINITY);
    if (tracer_hit(&t, &r, &none, &v)) {
        if (vec3_dot(normal, normal) > 0.0f)
            v.surface.shading_normal = normal;
        a = light_vertex(&scene, &v, &s);
    }
    put_answer(p, a);
    scene_free(&scene);
}

int main(int argc, char **argv)
{
    struct probe p = probe_open("probe_direct", argc, argv);
    bool fading = probe_is(&p, "fading");
    while (probe_more(&p)) {
        if (fading)
            run_fading(&p);
        else
            run_direct(&p);
    }
    return probe_close(&p);
}
