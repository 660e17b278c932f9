/* load_parts.h - the parts of a scene file, each read by a file of its own.
 *
 * Each function reads one member of the scene's top level (NULL: absent) into
 * *scene; faults are kept in the reader. */
#ifndef RAYBOOK_SCENE_LOAD_PARTS_H
#define RAYBOOK_SCENE_LOAD_PARTS_H

#include "scene/json_reader.h"
#include "scene/scene.h"

/* load_settings.c; load_integrator also makes the light of the keys
 * point_light_position and point_light_flux. */
void load_integrator(struct json_reader *j, const cJSON *node,
                     struct scene *scene);
void load_film(struct json_reader *j, const cJSON *node, struct scene *scene);
void load_camera(struct json_reader *j, const cJSON *node, struct scene *scene);
void load_sampler(struct json_reader *j, const cJSON *node,
                  struct scene *scene);

/* load_lights.c; every kind of light ends up in scene->lights. */
void load_lights(struct json_reader *j, const cJSON *node, struct scene *scene);
void load_environment(struct json_reader *j, const cJSON *textures,
                      const cJSON *node, struct scene *scene);

/* The light of an object: {"type": "area", "radiance": [r, g, b]}. */
void load_area_light(struct json_reader *j, const cJSON *node,
                     struct scene *scene, struct object *object);

/* Room for one more light, all zero; its place may move with the next. */
struct light *add_light(struct scene *scene, enum light_kind kind);

/* load_textures.c */
void load_textures(struct json_reader *j, const cJSON *node,
                   struct scene *scene);

/* load_materials.c; textures is the scene file's member, which materials
 * name. */
void load_materials(struct json_reader *j, const cJSON *textures,
                    const cJSON *node, struct scene *scene);

/* load_objects.c; materials is the scene file's member, which objects name. */
void load_objects(struct json_reader *j, const cJSON *materials,
                  const cJSON *node, struct scene *scene);

/* Which member of an object has the name that node (a string) gives; -1, with
 * a fault that suggests the nearest, when there is none. kind is "material". */
int find_named(struct json_reader *j, const cJSON *members, const cJSON *node,
               const char *kind);

/* A path relative to the folder of the scene file; the caller owns it. */
char *resolve_path(const struct json_reader *j, const char *path);

/* Checks that node is an object with a "type" and returns which of the names
 * it is; -1 after a fault. */
int read_type(struct json_reader *j, const cJSON *node,
              const char *const names[]);

#endif
