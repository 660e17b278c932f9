/* mesh.h - triangles that share vertices. */
#ifndef RAYBOOK_SHAPES_MESH_H
#define RAYBOOK_SHAPES_MESH_H

#include <stdbool.h>
#include <stdint.h>

#include "base/ray.h"
#include "base/transform.h"
#include "shapes/surface.h"
#include "shapes/triangle.h"

/* One index serves position, normal and texture coordinate. The mesh owns
 * its arrays: mesh_free. A mesh of zeros is empty and valid. */
struct mesh {
    vec3 *positions;
    vec3 *normals;     /* of length one or zero; NULL: none */
    vec2 *uvs;         /* NULL: none; v = 0 is the top row of an image */
    uint32_t *indices; /* three a triangle */
    uint32_t vertex_count, triangle_count;
};

/* The three corners of a triangle. */
void mesh_corners(const struct mesh *m, uint32_t triangle, vec3 corners[3]);

/* The surface at a hit. Without texture coordinates, uv is the pair of
 * barycentric coordinates (b1, b2). Vertex normals are interpolated and turned
 * to the side of the geometric normal, which follows the winding. */
void mesh_surface(const struct mesh *m, uint32_t triangle,
                  const struct triangle_hit *hit, struct surface *out);

/* Moves every vertex; normals by the inverse transpose. */
void mesh_transform(struct mesh *m, const struct transform *to_world);

/* A copy with arrays of its own. */
struct mesh mesh_copy(const struct mesh *m);

void mesh_free(struct mesh *m);

#endif
