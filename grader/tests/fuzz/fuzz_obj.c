/* fuzz_obj.c - the OBJ reader, and what its header promises of a mesh. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "fuzz_file.h"
#include "scene/obj_reader.h"

static void check(int holds, const char *promise)
{
    if (holds)
        return;
    fprintf(stderr, "broken: %s\n", promise);
    abort();
}

static void check_mesh(const struct mesh *m)
{
    check(m->triangle_count > 0, "triangle_count > 0");
    for (uint32_t i = 0; i < 3 * m->triangle_count; i++)
        check(m->indices[i] < m->vertex_count, "an index is in range");
    for (uint32_t i = 0; i < m->vertex_count; i++) {
        check(vec3_is_finite(m->positions[i]), "positions are finite");
        if (m->normals != NULL)
            check(vec3_is_finite(m->normals[i]), "normals are finite");
        if (m->uvs != NULL)
            check(isfinite(m->uvs[i].x) && isfinite(m->uvs[i].y),
                  "texture coordinates are finite");
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct mesh mesh;
    struct error err = {""};
    int fine = obj_read(fuzz_file("fuzz.obj", data, size), &mesh, &err);
    fuzz_check_message(fine, err.text);
    if (fine)
        check_mesh(&mesh);
    mesh_free(&mesh);
    return 0;
}
