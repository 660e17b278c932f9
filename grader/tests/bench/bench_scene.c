/* bench_scene.c - see bench_scene.h. */
#include "bench_scene.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

struct scene bench_scene_make(const struct mesh *m, enum accel_kind kind)
{
    struct scene scene;
    struct error err = {""};
    memset(&scene, 0, sizeof scene);
    scene.environment = -1;
    scene.objects = mem_alloc(1, sizeof *scene.objects);
    scene.objects->kind = OBJECT_MESH;
    scene.objects->mesh = *m;
    scene.objects->light = -1;
    scene.object_count = 1;
    if (!scene_prepare(&scene, kind, &err)) {
        fprintf(stderr, "bench: %s\n", err.text);
        exit(EXIT_FAILURE);
    }
    return scene;
}

int bench_accel_find(const char *name)
{
    for (int i = 0; accel_names[i] != NULL; i++)
        if (strcmp(accel_names[i], name) == 0)
            return accel_available((enum accel_kind)i) ? i : -1;
    return -1;
}

enum accel_kind bench_accel_best(void)
{
    int wide = bench_accel_find("wide");
    return wide >= 0 ? (enum accel_kind)wide : ACCEL_BVH;
}

void bench_scene_free(struct scene *scene)
{
    memset(&scene->objects->mesh, 0, sizeof scene->objects->mesh);
    scene_free(scene);
}
