/* probe_chain.c - sends rays through small scenes; judges nothing.
 *
 *   probe INPUT OUTPUT GROUP
 *
 * Words have 32 bits, little-endian (f = IEEE single, u = unsigned).
 * oracle_chain.py mirrors this layout. GROUP is not looked at.
 *
 *   INPUT   for each scene: u bytes of the scene file, that file's text (JSON),
 *           u number of rays, then for each ray 6 f: origin, direction
 *   OUTPUT  for each ray, in order, 3 f: what intersection_test_radiance
 *           returned
 *
 * A scene is loaded from a file, OUTPUT with ".json" after it, that is removed
 * again. */
#include "base/memory.h"
#include "integrators/intersection_test.h"
#include "probe.h"
#include "scene/load.h"

/* Makes the scene's file at `path`. */
static void write_scene(struct probe *p, const char *path)
{
    uint32_t size = take_word(p);
    char *text = mem_alloc(size, 1);
    take_bytes(p, text, size);
    FILE *file = probe_open_file(p, path, "wb");
    if (fwrite(text, 1, size, file) != size || fclose(file) != 0)
        probe_fail(p, path, "cannot be written");
    mem_free(text);
}

/* The scene whose file comes next in INPUT, ready to be asked. */
static void take_scene(struct probe *p, const char *path, struct scene *scene)
{
    struct error error = {{0}};
    write_scene(p, path);
    if (!scene_load(path, NULL, scene, &error) ||
        !scene_prepare(scene, ACCEL_BVH, &error))
        probe_fail(p, path, error.text);
    remove(path);
}

static rgb see(const struct scene *scene, uint32_t number, ray r)
{
    static const struct ray_differential none;
    struct sampler sampler =
        sampler_start(SAMPLER_INDEPENDENT, 1, number, 0, 1);
    struct tracer tracer = {scene, &sampler, NULL};
    return intersection_test_radiance(&tracer, r, none);
}

static void run(struct probe *p, const char *path)
{
    struct scene scene = {.environment = -1};
    take_scene(p, path, &scene);
    uint32_t rays = take_word(p);
    for (uint32_t i = 0; i < rays; i++) {
        vec3 origin = take_vec3(p), direction = take_vec3(p);
        ray r = ray_make(origin, direction, 0.0f, INFINITY);
        put_rgb(p, see(&scene, i, r));
    }
    scene_free(&scene);
}

int main(int argc, char **argv)
{
    struct probe p = probe_open("probe_chain", argc, argv);
    char *path = mem_alloc(strlen(p.output_name) + sizeof ".json", 1);
    strcat(strcpy(path, p.output_name), ".json");
    while (probe_more(&p))
        run(&p, path);
    mem_free(path);
    return probe_close(&p);
}
