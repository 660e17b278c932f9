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

/* load_lights.c */
void load_lights(struct json_reader *j, const cJSON *node, struct scene *scene);
void add_point_light(struct scene *scene, vec3 position, rgb flux);

/* load_materials.c; textures come first, materials name them. */
void load_textures(struct json_reader *j, const cJSON *node,
                   struct scene *scene);
void load_materials(struct json_reader *j, const cJSON *textures,
                    const cJSON *node, struct scene *scene);

/* load_objects.c; materials is the scene file's member, which objects name. */
void load_objects(struct json_reader *j, const cJSON *materials,
                  const cJSON *node, struct scene *scene);

/* Which member of an object has the name that node (a string) gives; -1, with
 * a fault that suggests the nearest, when there is none. kind is "material". */
int find_named(struct json_reader *j, const cJSON *members, const cJSON *node,
               const char *kind);

/* A fault: the format has this, this program does not yet. */
void not_supported(struct json_reader *j, const cJSON *node, const char *what);

#endif
