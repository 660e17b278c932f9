/* bench_caster.c - see bench_caster.h. */
#include "bench_caster.h"

#include <malloc.h>
#include <math.h>
#include <string.h>

#ifdef _OPENMP
#include <omp.h>
#endif

#include "base/memory.h"
#include "bench_clock.h"
#include "bench_scene.h"

static void ours_nearest(void *state, const struct bench_ray rays[],
                         size_t count, float t[])
{
    for (size_t i = 0; i < count; i++) {
        const struct bench_ray *b = &rays[i];
        ray r = ray_make(b->origin, b->direction, b->t_min, b->t_max);
        struct scene_hit hit;
        t[i] = scene_nearest(state, &r, &hit) ? hit.t : INFINITY;
    }
}

static void ours_any(void *state, const struct bench_ray rays[], size_t count,
                     float t[])
{
    for (size_t i = 0; i < count; i++) {
        const struct bench_ray *b = &rays[i];
        ray r = ray_make(b->origin, b->direction, b->t_min, b->t_max);
        t[i] = scene_any(state, &r) ? 0.0f : INFINITY;
    }
}

static void ours_release(void *state)
{
    bench_scene_free(state);
    mem_free(state);
}

/* What malloc has given out, large blocks of their own included. */
static double bytes_in_use(void)
{
    struct mallinfo2 m = mallinfo2();
    return (double)m.uordblks + (double)m.hblkhd;
}

static struct caster ours_build(const struct mesh *m, int threads,
                                enum accel_kind kind)
{
    struct caster c = {mem_alloc(1, sizeof(struct scene)),
                       ours_nearest,
                       ours_any,
                       ours_release,
                       0.0,
                       0.0,
                       0.0};
#ifdef _OPENMP
    omp_set_num_threads(threads);
#else
    (void)threads;
#endif
    double bytes = bytes_in_use();
    double wall = clock_wall(), cpu = clock_process();
    *(struct scene *)c.state = bench_scene_make(m, kind);
    c.build_wall = clock_wall() - wall;
    c.build_cpu = clock_process() - cpu;
    c.bytes = bytes_in_use() - bytes;
    return c;
}

bool caster_build(const char *name, const struct mesh *m, int threads,
                  struct caster *out)
{
    if (strncmp(name, "embree", 6) == 0) {
#ifdef RAYBOOK_EMBREE
        *out = embree_caster_build(m, threads, strcmp(name, "embree") != 0);
        return true;
#else
        return false;
#endif
    }
    int kind = bench_accel_find(name);
    if (kind >= 0)
        *out = ours_build(m, threads, (enum accel_kind)kind);
    return kind >= 0;
}

void caster_free(struct caster *c)
{
    c->release(c->state);
}
