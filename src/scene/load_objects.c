/* load_objects.c - the objects of a scene file. */
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "scene/load_parts.h"
#include "scene/models.h"

/* First `transform`, then `translate`. */
static struct transform load_placement(struct json_reader *j, const cJSON *node)
{
    struct transform t = json_transform(j, json_get(node, "transform"));
    vec3 zero = vec3_make(0.0f, 0.0f, 0.0f);
    return transform_translated(
        t, json_vec3(j, json_get(node, "translate"), zero));
}

/* Does every point of the box stay far within a float's range? */
static bool stays_small(const aabb *box, const struct transform *t)
{
    vec3 lower = vec3_abs(box->lower), upper = vec3_abs(box->upper);
    vec3 most = aabb_greater(lower, upper);
    float sum = 0.0f;
    for (int i = 0; i < 3; i++)
        sum += fabsf(t->m[i][0]) * most.x + fabsf(t->m[i][1]) * most.y +
               fabsf(t->m[i][2]) * most.z + fabsf(t->m[i][3]);
    return sum < 1e37f;
}

static void check_positions(struct json_reader *j, const cJSON *node,
                            const struct model *m, const struct transform *t)
{
    if (stays_small(&m->box, t))
        return;
    for (uint32_t i = 0; i < m->mesh.vertex_count; i++) {
        if (vec3_is_finite(transform_point(t, m->mesh.positions[i])))
            continue;
        json_fault(j, node, "the transform moves vertex %u out of range", i);
        return;
    }
}

/* An emitting mesh is always the object's own: light leaves it where it is. */
static void load_mesh(struct json_reader *j, const cJSON *node,
                      struct scene *scene, struct object *out)
{
    static const char *const keys[] = {
        "type",          "path",  "transform", "translate",
        "material_name", "light", NULL};
    json_keys(j, node, keys);
    const cJSON *path = json_require(j, node, "path");
    struct transform to_world = load_placement(j, node);
    const char *name = json_string(j, path, "");
    if (!json_fine(j))
        return;
    char *full = resolve_path(j, name);
    struct error fault = {""};
    struct model *model = models_find(scene, full, &fault);
    if (model == NULL) {
        json_fault(j, path, "%s", fault.text);
    } else {
        check_positions(j, node, model, &to_world);
        if (json_get(node, "light") != NULL)
            out->mesh = models_copy(model, &to_world);
        else
            models_show(model, &to_world, out);
    }
    mem_free(full);
}

static void load_sphere(struct json_reader *j, const cJSON *node,
                        struct object *out)
{
    static const char *const keys[] = {"type",          "center", "radius",
                                       "material_name", "light",  NULL};
    json_keys(j, node, keys);
    out->sphere.center = json_vec3(j, json_require(j, node, "center"),
                                   vec3_make(0.0f, 0.0f, 0.0f));
    out->sphere.radius =
        json_float(j, json_require(j, node, "radius"), above_zero, 1.0f);
}

static void load_rect(struct json_reader *j, const cJSON *node,
                      struct object *out)
{
    static const char *const keys[] = {
        "type", "transform", "translate", "material_name", "light", NULL};
    json_keys(j, node, keys);
    struct transform to_world = load_placement(j, node);
    out->rect = rect_make(&to_world);
    if (!(isfinite(out->rect.area) && out->rect.area > 0.0f))
        json_fault(j, node, "the transform leaves the rectangle no area");
}

/* An object that emits may do without a material: it does not reflect then. */
static void load_surface(struct json_reader *j, const cJSON *materials,
                         const cJSON *node, const struct scene *scene,
                         struct object *out)
{
    const cJSON *name = json_get(node, "material_name");
    if (name == NULL && json_get(node, "light") != NULL)
        return;
    name = json_require(j, node, "material_name");
    int material = name ? find_named(j, materials, name, "material") : -1;
    if (json_fine(j))
        out->material = &scene->materials[material];
}

static void load_object(struct json_reader *j, const cJSON *materials,
                        const cJSON *node, struct scene *scene,
                        struct object *out)
{
    static const char *const kinds[] = {"mesh", "sphere", "rect", NULL};
    int kind = read_type(j, node, kinds);
    out->light = -1;
    if (kind < 0)
        return;
    out->kind = (enum object_kind)kind;
    load_surface(j, materials, node, scene, out);
    if (!json_fine(j))
        return;
    if (out->kind == OBJECT_MESH)
        load_mesh(j, node, scene, out);
    else if (out->kind == OBJECT_SPHERE)
        load_sphere(j, node, out);
    else
        load_rect(j, node, out);
    load_area_light(j, json_get(node, "light"), scene, out);
}

void load_objects(struct json_reader *j, const cJSON *materials,
                  const cJSON *node, struct scene *scene)
{
    if (!json_fine(j) || node == NULL || !json_is_list(j, node))
        return;
    size_t count = (size_t)cJSON_GetArraySize(node);
    scene->objects = mem_alloc(count, sizeof *scene->objects);
    scene->models = mem_alloc(count, sizeof *scene->models);
    for (const cJSON *item = node->child; item && json_fine(j);
         item = item->next)
        load_object(j, materials, item, scene,
                    &scene->objects[scene->object_count++]);
}
