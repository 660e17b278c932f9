/* mesh_light.h - light from the triangles of a mesh. */
#ifndef RAYBOOK_LIGHTS_MESH_LIGHT_H
#define RAYBOOK_LIGHTS_MESH_LIGHT_H

#include "sampling/distribution.h"
#include "shapes/mesh.h"

/* The table that picks a triangle by its area: those without area, or with a
 * corner that is not finite, never. *area becomes the area of all. Release
 * with distribution_1d_free. */
struct distribution_1d mesh_light_table(const struct mesh *m, float *area);

/* A place on the mesh, evenly over its area, and the geometric normal there,
 * of length one. random: two numbers in [0, 1). area must be above 0. */
vec3 mesh_light_place(const struct mesh *m,
                      const struct distribution_1d *triangles, vec2 random,
                      vec3 *normal);

/* The longest edge of all triangles; 0 of none. */
float mesh_light_longest_edge(const struct mesh *m);

#endif
