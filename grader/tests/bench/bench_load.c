/* bench_load.c - how long does reading a mesh take?
 *
 *     bench load MESH.obj REPEATS
 *
 * Prints one JSON object: the triangles, and the seconds of each reading, by
 * the wall clock and of processor time. One reading more, first, brings the
 * file into memory. */
#include "bench_commands.h"

#include <stdio.h>
#include <stdlib.h>

#include "bench_clock.h"
#include "scene/obj_reader.h"

static uint32_t read_once(const char *path)
{
    struct mesh m;
    struct error err = {""};
    if (!obj_read(path, &m, &err)) {
        fprintf(stderr, "bench_load: %s\n", err.text);
        exit(EXIT_FAILURE);
    }
    uint32_t triangles = m.triangle_count;
    mesh_free(&m);
    return triangles;
}

int bench_load(int argc, char *argv[])
{
    if (argc != 3) {
        fprintf(stderr, "usage: bench load MESH.obj REPEATS\n");
        return 2;
    }
    printf("{\"triangles\": %u, \"seconds\": [", (unsigned)read_once(argv[1]));
    for (int i = 0; i < atoi(argv[2]); i++) {
        double wall = clock_wall(), cpu = clock_process();
        read_once(argv[1]);
        printf("%s[%.6f, %.6f]", i > 0 ? ", " : "", clock_wall() - wall,
               clock_process() - cpu);
    }
    printf("]}\n");
    return 0;
}
