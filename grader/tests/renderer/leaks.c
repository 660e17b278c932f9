/* leaks.c - does a closed mesh leak rays?
 *
 *     hits leaks MESH.obj INSIDE.txt RAYS SEED PLACES ACCEL
 *
 * Casts so many rays from the points inside, the four kinds of hit_world.h,
 * by all threads, and asks for the nearest hit and for any. Every one must
 * hit. Prints counts as one JSON object; a few of the rays that escape are
 * told on standard error. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "hit_world.h"

enum { MOST_TOLD = 5 };

static void tell(const char *what, uint64_t index)
{
    static int told;
#pragma omp critical
    if (told++ < MOST_TOLD)
        fprintf(stderr, "ray %" PRIu64 " escapes: %s\n", index, what);
}

static enum accel_kind find_accel(const char *name)
{
    for (int i = 0; accel_names[i] != NULL; i++)
        if (strcmp(accel_names[i], name) == 0)
            return (enum accel_kind)i;
    hit_stop(name, "no such structure");
    return ACCEL_WIDE;
}

int leaks(int argc, char *argv[])
{
    if (argc != 7)
        hit_stop("usage",
                 "hits leaks MESH.obj INSIDE.txt RAYS SEED PLACES ACCEL");
    struct hit_world w =
        hit_world_read(argv[1], argv[2], (uint32_t)strtoul(argv[5], NULL, 10));
    struct scene scene = hit_world_scene(&w, find_accel(argv[6]));
    uint64_t rays = strtoull(argv[3], NULL, 10);
    uint64_t seed = strtoull(argv[4], NULL, 10);
    uint64_t nearest = 0, any = 0;
    if (w.inside_count == 0)
        hit_stop(argv[2], "names no point inside");
#pragma omp parallel for schedule(static, 4096) reduction(+ : nearest, any)
    for (uint64_t i = 0; i < rays; i++) {
        struct surface start;
        struct scene_hit hit;
        uint64_t index = 2 * i + 1; /* those that start inside */
        vec3 direction = hit_world_ray(&w, seed, index, &start);
        ray r = surface_ray(&start, direction, INFINITY);
        if (!scene_nearest(&scene, &r, &hit)) {
            nearest++;
            tell("nearest", index);
        }
        if (!scene_direction_blocked(&scene, &start, direction)) {
            any++;
            tell("any", index);
        }
    }
    printf("{\"rays\": %" PRIu64 ", \"primitives\": %u, \"leaks\": %" PRIu64
           ", \"unblocked\": %" PRIu64 "}\n",
           rays, (unsigned)scene.primitive_count, nearest, any);
    return 0;
}
