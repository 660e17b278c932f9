/* bench_build.c - how long do the casters take to build, and what do they hold?
 *
 *     bench build MESH REPEATS CASTER:THREADS ...
 *
 * Builds each in turn, over and over (one more round, first, to warm up), and
 * prints one JSON object: by CASTER:THREADS the seconds of each build, by the
 * wall clock and of processor time, and the bytes held beside the mesh. */
#include "bench_commands.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "bench_caster.h"

enum { MOST_ENTRIES = 16, NAME_SIZE = 32 };

struct entry {
    const char *label;
    char name[NAME_SIZE];
    int threads;
    double *wall, *cpu; /* of each repetition */
    double bytes;
};

/* Returns false when the build has no such caster. */
static bool build_once(const struct entry *e, const struct mesh *m,
                       struct caster *c)
{
    if (!caster_build(e->name, m, e->threads, c))
        return false;
    caster_free(c);
    return true;
}

static void entry_make(struct entry *e, const char *label, int repeats)
{
    const char *colon = strchr(label, ':');
    size_t length = colon != NULL ? (size_t)(colon - label) : strlen(label);
    e->label = label;
    e->threads = colon != NULL ? atoi(colon + 1) : 1;
    snprintf(e->name, sizeof e->name, "%.*s", (int)length, label);
    e->wall = mem_alloc((size_t)repeats, sizeof *e->wall);
    e->cpu = mem_alloc((size_t)repeats, sizeof *e->cpu);
}

/* Those that the build has; they are warm afterwards. */
static int make_entries(struct entry *entries, char *labels[],
                        const struct mesh *m, int repeats)
{
    int count = 0;
    for (; *labels != NULL && count < MOST_ENTRIES; labels++) {
        struct caster c;
        entry_make(&entries[count], *labels, repeats);
        if (build_once(&entries[count], m, &c))
            entries[count++].bytes = c.bytes;
    }
    return count;
}

static void print_list(const char *name, const double *list, int count)
{
    printf("\"%s\": [", name);
    for (int i = 0; i < count; i++)
        printf("%s%.6f", i > 0 ? ", " : "", list[i]);
    printf("]");
}

static void print(const struct entry *entries, int count, int repeats,
                  uint32_t triangles)
{
    printf("{\"triangles\": %u, \"casters\": {", (unsigned)triangles);
    for (int i = 0; i < count; i++) {
        const struct entry *e = &entries[i];
        printf("%s\"%s\": {\"bytes\": %.0f, ", i > 0 ? ", " : "", e->label,
               e->bytes);
        print_list("wall", e->wall, repeats);
        printf(", ");
        print_list("cpu", e->cpu, repeats);
        printf("}");
    }
    printf("}}\n");
}

int bench_build(int argc, char *argv[])
{
    struct bench_mesh b;
    struct entry entries[MOST_ENTRIES];
    if (argc < 4 || !bench_mesh_make(argv[1], &b)) {
        fprintf(stderr, "usage: bench build box|knot|terrain REPEATS "
                        "CASTER:THREADS ...\n");
        return 2;
    }
    int repeats = atoi(argv[2]);
    int count = make_entries(entries, argv + 3, &b.mesh, repeats);
    for (int k = 0; k < repeats; k++)
        for (int i = 0; i < count; i++) {
            struct caster c = {0};
            build_once(&entries[i], &b.mesh, &c);
            entries[i].wall[k] = c.build_wall;
            entries[i].cpu[k] = c.build_cpu;
        }
    print(entries, count, repeats, b.mesh.triangle_count);
    mesh_free(&b.mesh);
    return 0;
}
