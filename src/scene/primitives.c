/* primitives.c - see primitives.h. */
#include "scene/primitives.h"

#include "base/memory.h"

static const uint64_t most_primitives = UINT32_MAX / 4;

static uint32_t primitives_of(const struct object *o)
{
    if (o->kind != OBJECT_MESH)
        return 1;
    return o->model != NULL ? o->model->mesh.triangle_count
                            : o->mesh.triangle_count;
}

bool primitives_count(struct scene *scene, struct error *err)
{
    uint64_t count = 0;
    scene->first_primitive =
        mem_alloc((size_t)scene->object_count + 1, sizeof(uint32_t));
    for (uint32_t i = 0; i < scene->object_count; i++) {
        scene->first_primitive[i] = (uint32_t)count;
        count += primitives_of(&scene->objects[i]);
        if (count > most_primitives)
            return error_set(err, "more than %llu primitives",
                             (unsigned long long)most_primitives);
    }
    scene->first_primitive[scene->object_count] = (uint32_t)count;
    scene->primitive_count = (uint32_t)count;
    return true;
}

static uint32_t listed_of(const struct object *o)
{
    return o->model != NULL ? 1 : primitives_of(o);
}

uint32_t *primitives_listed(const struct scene *scene, uint32_t *count)
{
    *count = 0;
    for (uint32_t i = 0; i < scene->object_count; i++)
        *count += listed_of(&scene->objects[i]);
    if (*count == scene->primitive_count)
        return NULL;
    uint32_t *numbers = mem_alloc(*count, sizeof *numbers), *next = numbers;
    for (uint32_t i = 0; i < scene->object_count; i++)
        for (uint32_t k = 0; k < listed_of(&scene->objects[i]); k++)
            *next++ = scene->first_primitive[i] + k;
    return numbers;
}

/* The last object that begins at or before the primitive and is not empty: a
 * binary search between one that does begin so and one that does not. */
uint32_t primitive_object(const struct scene *scene, uint32_t primitive)
{
    uint32_t at = 0, beyond = scene->object_count;
    while (beyond - at > 1) {
        uint32_t middle = at + (beyond - at) / 2;
        if (scene->first_primitive[middle] <= primitive)
            at = middle;
        else
            beyond = middle;
    }
    return at;
}

bool primitive_corners(const void *scene, uint32_t primitive, vec3 corners[3])
{
    const struct scene *s = scene;
    uint32_t object = primitive_object(s, primitive);
    const struct object *o = &s->objects[object];
    if (o->kind != OBJECT_MESH || o->model != NULL)
        return false;
    mesh_corners(&o->mesh, primitive - s->first_primitive[object], corners);
    return true;
}

aabb primitive_box(const void *scene, uint32_t primitive)
{
    const struct scene *s = scene;
    uint32_t object = primitive_object(s, primitive);
    const struct object *o = &s->objects[object];
    vec3 p[3];
    if (o->kind == OBJECT_SPHERE)
        return sphere_bounds(&o->sphere);
    if (o->kind == OBJECT_RECT)
        return rect_bounds(&o->rect);
    if (o->model != NULL)
        return o->box;
    mesh_corners(&o->mesh, primitive - s->first_primitive[object], p);
    return aabb_include(aabb_include(aabb_include(aabb_empty(), p[0]), p[1]),
                        p[2]);
}
