/* primitives.h - all that rays can hit in a scene, one by one.
 *
 * Primitives are numbered in the order of the file, object by object, a mesh's
 * triangles in the mesh's order. */
#ifndef RAYBOOK_SCENE_PRIMITIVES_H
#define RAYBOOK_SCENE_PRIMITIVES_H

#include <stdbool.h>
#include <stdint.h>

#include "base/box.h"
#include "scene/scene.h"

/* Fills primitive_count and first_primitive, which the others need. False, with
 * *err filled, when there are too many. */
bool primitives_count(struct scene *scene, struct error *err);

/* The numbers of the primitives that a tree is built over: all, but of an
 * object that shows a model only the first, which stands for the object. The
 * caller owns them; NULL: there is no such object, and *count is all. */
uint32_t *primitives_listed(const struct scene *scene, uint32_t *count);

/* The object that a primitive belongs to. */
uint32_t primitive_object(const struct scene *scene, uint32_t primitive);

/* Its corners; false if it is no triangle, or one of a model. The pointer is to
 * a struct scene: these two are what wide_build asks. */
bool primitive_corners(const void *scene, uint32_t primitive, vec3 corners[3]);

/* The box of a primitive, a triangle or not; of a model's, the object's. */
aabb primitive_box(const void *scene, uint32_t primitive);

#endif
