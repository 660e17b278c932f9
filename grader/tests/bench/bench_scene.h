/* bench_scene.h - a scene that holds one mesh and nothing else. */
#ifndef RAYBOOK_BENCH_SCENE_H
#define RAYBOOK_BENCH_SCENE_H

#include "scene/scene.h"

/* Ready to be asked. The mesh stays the caller's and must outlive the scene.
 * Stops the program when there are too many triangles. Release with
 * bench_scene_free. */
struct scene bench_scene_make(const struct mesh *m, enum accel_kind kind);

/* The number of an accelerator's name; -1: this build has none such. */
int bench_accel_find(const char *name);

/* The quickest to build and to ask that this build has; all answer alike. */
enum accel_kind bench_accel_best(void);

void bench_scene_free(struct scene *scene);

#endif
