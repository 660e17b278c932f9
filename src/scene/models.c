/* models.c - see models.h. */
#include "scene/models.h"

#include <string.h>

#include "base/memory.h"
#include "scene/obj_reader.h"

/* A mesh of fewer triangles is copied: a placement holds about as much, and to
 * move a ray takes as long as to test some dozens. */
enum { FEW_TRIANGLES = 256 };

static aabb box_of(const struct mesh *m)
{
    aabb box = aabb_empty();
    for (uint32_t i = 0; i < m->vertex_count; i++)
        box = aabb_include(box, m->positions[i]);
    return box;
}

struct model *models_find(struct scene *scene, const char *path,
                          struct error *err)
{
    for (uint32_t i = 0; i < scene->model_count; i++)
        if (strcmp(scene->models[i].path, path) == 0)
            return &scene->models[i];
    struct model *m = &scene->models[scene->model_count];
    if (!obj_read(path, &m->mesh, err))
        return NULL;
    m->path = mem_copy_string(path);
    m->box = box_of(&m->mesh);
    scene->model_count++;
    return m;
}

void models_show(struct model *model, const struct transform *to_world,
                 struct object *object)
{
    object->model = model;
    object->place.to_world = *to_world;
    model->shown++;
}

struct mesh models_copy(const struct model *model,
                        const struct transform *to_world)
{
    struct mesh copy = mesh_copy(&model->mesh);
    mesh_transform(&copy, to_world);
    return copy;
}

/* Preparing --------------------------------------------------------------- */

static void drop_mesh(struct model *m)
{
    mesh_free(&m->mesh);
    memset(&m->mesh, 0, sizeof m->mesh);
}

/* Gives the object a mesh of its own; the last one takes the model's. */
static void detach(struct object *object)
{
    struct model *m = object->model;
    object->model = NULL;
    if (--m->shown > 0) {
        object->mesh = models_copy(m, &object->place.to_world);
        return;
    }
    object->mesh = m->mesh;
    memset(&m->mesh, 0, sizeof m->mesh);
    mesh_transform(&object->mesh, &object->place.to_world);
}

/* The box of the corners as they are in the world. */
static aabb placed_box(const struct object *o)
{
    const struct mesh *m = &o->model->mesh;
    aabb box = aabb_empty();
    for (uint32_t i = 0; i < m->vertex_count; i++)
        box = aabb_include(
            box, transform_point(&o->place.to_world, m->positions[i]));
    return box;
}

static bool is_worth_while(const struct model *m)
{
    return m->shown > 1 && m->mesh.triangle_count >= FEW_TRIANGLES;
}

/* Returns whether the object can go on showing its model. */
static bool place(const struct scene *scene, uint32_t index)
{
    struct object *o = &scene->objects[index];
    const struct transform to_world = o->place.to_world;
    return placement_make(&to_world, scene->first_primitive[index],
                          &o->model->box, &o->place);
}

static bool triangle_of(const void *mesh, uint32_t triangle, vec3 corners[3])
{
    mesh_corners(mesh, triangle, corners);
    return true;
}

static void build_tree(struct model *m)
{
    const struct wide_source source = {m->mesh.triangle_count, NULL, &m->mesh,
                                       triangle_of, NULL};
    m->tree = wide_build(&source);
}

static void detach_some(struct scene *scene, enum accel_kind kind)
{
    for (uint32_t i = 0; i < scene->object_count; i++)
        if (scene->objects[i].model != NULL &&
            !(kind == ACCEL_WIDE && is_worth_while(scene->objects[i].model) &&
              place(scene, i)))
            detach(&scene->objects[i]);
}

void models_prepare(struct scene *scene, enum accel_kind kind)
{
    detach_some(scene, kind);
    for (uint32_t i = 0; i < scene->model_count; i++)
        if (scene->models[i].shown > 0)
            build_tree(&scene->models[i]);
        else
            drop_mesh(&scene->models[i]);
#pragma omp parallel for schedule(dynamic)
    for (uint32_t i = 0; i < scene->object_count; i++)
        if (scene->objects[i].model != NULL)
            scene->objects[i].box = placed_box(&scene->objects[i]);
}

/* Shading ----------------------------------------------------------------- */

/* One triangle of the mesh, moved as the whole mesh would be. */
void models_surface(const struct object *object, uint32_t triangle,
                    const struct triangle_hit *hit, struct surface *out)
{
    const struct mesh *m = &object->model->mesh;
    const uint32_t *index = &m->indices[3 * (size_t)triangle];
    vec3 positions[3], normals[3];
    vec2 uvs[3];
    uint32_t indices[3] = {0, 1, 2};
    struct mesh one = {
        positions, m->normals ? normals : NULL, m->uvs ? uvs : NULL, indices, 3,
        1};
    for (int i = 0; i < 3; i++) {
        positions[i] = m->positions[index[i]];
        if (m->normals != NULL)
            normals[i] = m->normals[index[i]];
        if (m->uvs != NULL)
            uvs[i] = m->uvs[index[i]];
    }
    mesh_transform(&one, &object->place.to_world);
    mesh_surface(&one, 0, hit, out);
}

void models_free(struct scene *scene)
{
    for (uint32_t i = 0; i < scene->model_count; i++) {
        mem_free(scene->models[i].path);
        mesh_free(&scene->models[i].mesh);
        wide_free(&scene->models[i].tree);
    }
    mem_free(scene->models);
}
