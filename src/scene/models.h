/* models.h - meshes that several objects show, and what it means to be one of
 * those objects.
 *
 * Every OBJ file is read once. As long as an object only says which mesh it
 * shows, and where (struct object: model and place), it costs a few hundred
 * bytes, however many triangles the mesh has. Where that is not worth while,
 * or not possible, the object gets a mesh of its own, moved to the world. */
#ifndef RAYBOOK_SCENE_MODELS_H
#define RAYBOOK_SCENE_MODELS_H

#include <stdbool.h>

#include "base/error.h"
#include "scene/scene.h"

/* The model of an OBJ file: read now, unless it is known. NULL, with *err
 * filled, if it cannot be read. scene->models must have room for one more. */
struct model *models_find(struct scene *scene, const char *path,
                          struct error *err);

/* Makes the object one that shows the model (and has none yet). */
void models_show(struct model *model, const struct transform *to_world,
                 struct object *object);

/* The model's mesh as one of its own, in the world. The caller owns it. */
struct mesh models_copy(const struct model *model,
                        const struct transform *to_world);

/* Decides which objects go on showing a model: those of meshes of many
 * triangles that are shown several times, in moderate places, if kind can walk
 * through them. The others get meshes of their own. Builds the trees of the
 * models that are left. Needs first_primitive. */
void models_prepare(struct scene *scene, enum accel_kind kind);

/* scene_surface of an object that shows a model. */
void models_surface(const struct object *object, uint32_t triangle,
                    const struct triangle_hit *hit, struct surface *out);

void models_free(struct scene *scene);

#endif
