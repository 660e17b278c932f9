/* bench_cast.c - how fast do the casters answer the same rays?
 *
 *     bench cast MESH RAYS REPEATS CASTER ...
 *
 * Casts so many rays of each kind through every caster in turn, over and over,
 * and prints one JSON object: for each kind and caster the seconds of
 * processor time of each repetition (the first, to warm up, is left out), how
 * many rays hit, and how many answers differ from the first caster's. The
 * process should be bound to one processor. */
#include "bench_commands.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/memory.h"
#include "bench_caster.h"
#include "bench_clock.h"

enum { MOST_CASTERS = 8 };

/* Two answers differ when one hits and the other does not, or the distances
 * are further apart than rounding puts them. */
static const float t_tolerance = 1e-3f;

struct contest {
    const char *names[MOST_CASTERS];
    struct caster casters[MOST_CASTERS];
    int caster_count;
    struct bench_rays rays;
    int repeats;
    double *seconds; /* of [caster][repetition], for the kind at hand */
    float *first, *t;
    size_t hits[MOST_CASTERS], differ[MOST_CASTERS];
};

static double cast(const struct contest *c, int i, enum ray_kind kind, float *t)
{
    const struct caster *caster = &c->casters[i];
    double start = clock_thread();
    if (kind == RAYS_SHADOW)
        caster->any(caster->state, c->rays.rays[kind], c->rays.count, t);
    else
        caster->nearest(caster->state, c->rays.rays[kind], c->rays.count, t);
    return clock_thread() - start;
}

static bool same(float a, float b)
{
    if (isinf(a) || isinf(b))
        return isinf(a) && isinf(b);
    return fabsf(a - b) <= t_tolerance * fabsf(a);
}

/* The first round warms up, and its answers are looked at. */
static void compare(struct contest *c, enum ray_kind kind)
{
    for (int i = 0; i < c->caster_count; i++) {
        cast(c, i, kind, i == 0 ? c->first : c->t);
        const float *t = i == 0 ? c->first : c->t;
        c->hits[i] = c->differ[i] = 0;
        for (size_t k = 0; k < c->rays.count; k++) {
            c->hits[i] += !isinf(t[k]);
            c->differ[i] += !same(c->first[k], t[k]);
        }
    }
}

static void measure(struct contest *c, enum ray_kind kind)
{
    compare(c, kind);
    for (int repeat = 0; repeat < c->repeats; repeat++)
        for (int i = 0; i < c->caster_count; i++)
            c->seconds[i * c->repeats + repeat] = cast(c, i, kind, c->t);
}

static void print_kind(const struct contest *c, enum ray_kind kind)
{
    printf("%s\"%s\": {", kind > 0 ? ", " : "", ray_kind_names[kind]);
    for (int i = 0; i < c->caster_count; i++) {
        printf("%s\"%s\": {\"hits\": %zu, \"differ\": %zu, \"seconds\": [",
               i > 0 ? ", " : "", c->names[i], c->hits[i], c->differ[i]);
        for (int k = 0; k < c->repeats; k++)
            printf("%s%.9f", k > 0 ? ", " : "", c->seconds[i * c->repeats + k]);
        printf("]}");
    }
    printf("}");
}

/* Casters that this build has not are passed over. */
static void build_casters(struct contest *c, const struct mesh *m,
                          char *names[])
{
    for (; *names != NULL && c->caster_count < MOST_CASTERS; names++)
        if (caster_build(*names, m, 1, &c->casters[c->caster_count]))
            c->names[c->caster_count++] = *names;
}

static void run(struct contest *c, const struct bench_mesh *b, char *names[])
{
    build_casters(c, &b->mesh, names);
    c->seconds = mem_alloc((size_t)c->caster_count * (size_t)c->repeats,
                           sizeof *c->seconds);
    c->first = mem_alloc(c->rays.count, sizeof *c->first);
    c->t = mem_alloc(c->rays.count, sizeof *c->t);
    printf("{\"triangles\": %u, \"rays\": %zu, \"kinds\": {",
           (unsigned)b->mesh.triangle_count, c->rays.count);
    for (int kind = 0; kind < RAY_KINDS; kind++) {
        measure(c, (enum ray_kind)kind);
        print_kind(c, (enum ray_kind)kind);
    }
    printf("}}\n");
}

static void clean_up(struct contest *c, struct bench_mesh *b)
{
    for (int i = 0; i < c->caster_count; i++)
        caster_free(&c->casters[i]);
    mem_free(c->seconds);
    mem_free(c->first);
    mem_free(c->t);
    bench_rays_free(&c->rays);
    mesh_free(&b->mesh);
}

int bench_cast(int argc, char *argv[])
{
    struct bench_mesh b;
    static struct contest c;
    if (argc < 5 || !bench_mesh_make(argv[1], &b)) {
        fprintf(stderr, "usage: bench cast box|knot|terrain RAYS REPEATS "
                        "CASTER ...\n");
        return 2;
    }
    c.rays = bench_rays_make(&b, strtoull(argv[2], NULL, 10));
    c.repeats = atoi(argv[3]);
    run(&c, &b, argv + 4);
    clean_up(&c, &b);
    return 0;
}
