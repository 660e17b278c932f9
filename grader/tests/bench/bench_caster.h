/* bench_caster.h - what is measured: a structure over a mesh that answers rays.
 *
 * Ours go by the names of accel_names, through scene_nearest and scene_any, as
 * in the renderer. The peers are Embree's own triangles and traversal, one ray
 * at a time, medium build quality: "embree" as it is by default, and
 * "embree-robust", with RTC_SCENE_FLAG_ROBUST, which leaks no ray between
 * triangles. (The renderer's accelerator "embree" is another thing: it tests
 * our triangles.) */
#ifndef RAYBOOK_BENCH_CASTER_H
#define RAYBOOK_BENCH_CASTER_H

#include <stdbool.h>
#include <stddef.h>

#include "bench_rays.h"
#include "shapes/mesh.h"

/* state is the kind's own. nearest stores each ray's t, infinite on a miss;
 * any stores 0 where there is a hit and infinity where there is none. */
struct caster {
    void *state;
    void (*nearest)(void *state, const struct bench_ray rays[], size_t count,
                    float t[]);
    void (*any)(void *state, const struct bench_ray rays[], size_t count,
                float t[]);
    void (*release)(void *state);

    double build_wall, build_cpu; /* seconds that the build took */
    double bytes;                 /* that it holds beside the mesh */
};

/* Builds the caster of this name over a mesh, which must outlive it, with so
 * many threads. Returns false when this build has none such. */
bool caster_build(const char *name, const struct mesh *m, int threads,
                  struct caster *out);

void caster_free(struct caster *c);

/* bench_embree.c; only where Embree is installed. */
struct caster embree_caster_build(const struct mesh *m, int threads,
                                  bool robust);

#endif
