/* bench_mesh.h - the meshes that rays are cast at, made from formulas.
 *
 *     box      1 thousand triangles: a Cornell box with two spheres
 *     knot     100 thousand: a fluted torus knot before two walls; what fits
 *              into the caches
 *     terrain  2 million: hills, seen from above; what does not fit */
#ifndef RAYBOOK_BENCH_MESH_H
#define RAYBOOK_BENCH_MESH_H

#include <stdbool.h>

#include "scene/settings.h"
#include "shapes/mesh.h"

/* A mesh, somebody who looks at it, and a lamp: the parallelogram with a
 * corner and two sides. */
struct bench_mesh {
    struct mesh mesh; /* positions and indices only */
    struct camera_settings camera;
    vec3 lamp, lamp_u, lamp_v;
};

/* Makes the mesh of this name; release with mesh_free. Returns false, with
 * *out all zero, when there is none. */
bool bench_mesh_make(const char *name, struct bench_mesh *out);

#endif
