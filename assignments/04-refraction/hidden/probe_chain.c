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
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "integrators/intersection_test.h"
#include "scene/load.h"

enum { RAY_WORDS = 6, COLOR_WORDS = 3 };

static void fail(const char *file, const char *what)
{
    fprintf(stderr, "probe_chain: %s: %s\n", file, what);
    exit(2);
}

static FILE *open_or_fail(const char *name, const char *mode)
{
    FILE *file = fopen(name, mode);
    if (!file)
        fail(name, "cannot be opened");
    return file;
}

static void read_or_fail(FILE *file, const char *name, void *bytes, size_t size)
{
    if (fread(bytes, 1, size, file) != size)
        fail(name, "ends inside a scene; expected whole ones");
}

static uint32_t word_of(const unsigned char b[4])
{
    return (uint32_t)b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 |
           (uint32_t)b[3] << 24;
}

/* The next word; false at the end of the file. */
static bool read_word(FILE *file, const char *name, uint32_t *word)
{
    unsigned char bytes[4];
    int first = fgetc(file);
    if (first == EOF)
        return false;
    bytes[0] = (unsigned char)first;
    read_or_fail(file, name, bytes + 1, 3);
    *word = word_of(bytes);
    return true;
}

/* The scene whose file comes next in INPUT, ready to be asked. */
static void read_scene(FILE *input, const char *name, uint32_t size,
                       const char *path, struct scene *scene)
{
    struct error error = {{0}};
    char *text = mem_alloc(size, 1);
    FILE *file = open_or_fail(path, "wb");
    read_or_fail(input, name, text, size);
    if (fwrite(text, 1, size, file) != size || fclose(file) != 0)
        fail(path, "cannot be written");
    mem_free(text);
    if (!scene_load(path, NULL, scene, &error) ||
        !scene_prepare(scene, ACCEL_BVH, &error))
        fail(path, error.text);
    remove(path);
}

static ray read_ray(FILE *input, const char *name)
{
    unsigned char bytes[4 * RAY_WORDS];
    float f[RAY_WORDS];
    read_or_fail(input, name, bytes, sizeof bytes);
    for (int i = 0; i < RAY_WORDS; i++) {
        uint32_t word = word_of(bytes + 4 * i);
        memcpy(&f[i], &word, sizeof word);
    }
    return ray_make(vec3_make(f[0], f[1], f[2]), vec3_make(f[3], f[4], f[5]),
                    0.0f, INFINITY);
}

static void write_color(FILE *output, const char *name, rgb color)
{
    const float f[COLOR_WORDS] = {color.r, color.g, color.b};
    unsigned char bytes[4 * COLOR_WORDS];
    for (size_t i = 0; i < COLOR_WORDS; i++) {
        uint32_t word;
        memcpy(&word, &f[i], sizeof word);
        for (size_t k = 0; k < 4; k++)
            bytes[4 * i + k] = (unsigned char)(word >> (8 * k));
    }
    if (fwrite(bytes, 1, sizeof bytes, output) != sizeof bytes)
        fail(name, "cannot be written");
}

static rgb see(const struct scene *scene, uint32_t number, ray r)
{
    static const struct ray_differential none;
    struct sampler sampler =
        sampler_start(SAMPLER_INDEPENDENT, 1, number, 0, 1);
    struct tracer tracer = {scene, &sampler, NULL};
    return intersection_test_radiance(&tracer, r, none);
}

int main(int argc, char **argv)
{
    if (argc != 4) {
        fprintf(stderr, "usage: probe_chain INPUT OUTPUT GROUP\n");
        return 2;
    }
    FILE *input = open_or_fail(argv[1], "rb");
    FILE *output = open_or_fail(argv[2], "wb");
    char *path = mem_alloc(strlen(argv[2]) + sizeof ".json", 1);
    strcat(strcpy(path, argv[2]), ".json");
    uint32_t size, rays;
    while (read_word(input, argv[1], &size)) {
        struct scene scene = {.environment = -1};
        read_scene(input, argv[1], size, path, &scene);
        if (!read_word(input, argv[1], &rays))
            fail(argv[1], "ends inside a scene; expected whole ones");
        for (uint32_t i = 0; i < rays; i++)
            write_color(output, argv[2],
                        see(&scene, i, read_ray(input, argv[1])));
        scene_free(&scene);
    }
    if (fclose(output) != 0)
        fail(argv[2], "cannot be written");
    fclose(input);
    mem_free(path);
    return 0;
}
