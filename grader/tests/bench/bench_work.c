/* bench_work.c - how much does a structure ask for each ray?
 *
 *     bench work MESH RAYS ACCELERATOR
 *
 * Prints one JSON object: for each kind of rays the boxes and primitives
 * tested and the rays that hit. Linked with another module in place of
 * src/accel/bvh.c it tells of that one. */
#include "bench_commands.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/memory.h"
#include "bench_caster.h"
#include "base/counters.h"

static void cast_kind(const struct caster *c, const struct bench_rays *rays,
                      enum ray_kind kind, float *t)
{
    struct counters before = {0}, work = {0};
    size_t hits = 0;
    counters_flush(&before);
    if (kind == RAYS_SHADOW)
        c->any(c->state, rays->rays[kind], rays->count, t);
    else
        c->nearest(c->state, rays->rays[kind], rays->count, t);
    counters_flush(&work);
    for (size_t i = 0; i < rays->count; i++)
        hits += !isinf(t[i]);
    printf("%s\"%s\": {\"boxes\": %llu, \"primitives\": %llu, \"hits\": %zu}",
           kind > 0 ? ", " : "", ray_kind_names[kind],
           (unsigned long long)work.boxes_tested,
           (unsigned long long)work.primitives_tested, hits);
}

int bench_work(int argc, char *argv[])
{
    struct bench_mesh b;
    struct caster c;
    if (argc != 4 || !bench_mesh_make(argv[1], &b) ||
        !caster_build(argv[3], &b.mesh, 1, &c)) {
        fprintf(stderr,
                "usage: bench work box|knot|terrain RAYS ACCELERATOR\n");
        return 2;
    }
    struct bench_rays rays = bench_rays_make(&b, strtoull(argv[2], NULL, 10));
    float *t = mem_alloc(rays.count, sizeof *t);
    printf("{\"triangles\": %u, \"rays\": %zu, \"kinds\": {",
           (unsigned)b.mesh.triangle_count, rays.count);
    for (int kind = 0; kind < RAY_KINDS; kind++)
        cast_kind(&c, &rays, (enum ray_kind)kind, t);
    printf("}}\n");
    mem_free(t);
    caster_free(&c);
    bench_rays_free(&rays);
    mesh_free(&b.mesh);
    return 0;
}
