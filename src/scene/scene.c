/* scene.c - what a ray hits in a scene; see scene.h. */
#include "scene/scene.h"

#include "base/memory.h"
#include "scene/models.h"
#include "scene/primitives.h"

/* Everything's box goes to *all. */
static struct accel build_wide(const struct scene *scene, aabb *all)
{
    struct wide_source source = {scene->primitive_count, NULL, scene,
                                 primitive_corners, primitive_box};
    uint32_t *listed = primitives_listed(scene, &source.count);
    source.numbers = listed;
    struct accel accel = accel_build_wide(&source);
    *all = accel.wide.box;
    mem_free(listed);
    return accel;
}

/* Copies of the primitives, in the order in which leaves name them. */
static struct primitive *copy_primitives(const struct scene *scene,
                                         const uint32_t order[])
{
    struct primitive *p = mem_alloc(scene->primitive_count, sizeof *p);
    for (uint32_t i = 0; i < scene->primitive_count; i++) {
        p[i].number = order[i];
        p[i].object = primitive_object(scene, order[i]);
        primitive_corners(scene, order[i], p[i].corners);
    }
    return p;
}

static struct accel build_other(struct scene *scene, enum accel_kind kind,
                                aabb *all)
{
    uint32_t count = scene->primitive_count;
    aabb *boxes = mem_alloc(count, sizeof *boxes);
    uint32_t *order = mem_alloc(count, sizeof *order);
    *all = aabb_empty();
    for (uint32_t i = 0; i < count; i++) {
        boxes[i] = primitive_box(scene, i);
        *all = aabb_union(*all, boxes[i]);
    }
    struct accel accel = accel_build(kind, boxes, count, order);
    scene->primitives = copy_primitives(scene, order);
    mem_free(boxes);
    mem_free(order);
    return accel;
}

/* The radius of a sphere around the box of everything; at least a little, so
 * that an empty scene's lights have a power. */
static float bounding_radius(const aabb *box)
{
    float radius = 0.5f * vec3_length(vec3_sub(box->upper, box->lower));
    return isfinite(radius) && radius > 0.0f ? radius : 1.0f;
}

bool scene_prepare(struct scene *scene, enum accel_kind kind, struct error *err)
{
    aabb all;
    if (!primitives_count(scene, err))
        return false;
    models_prepare(scene, kind);
    scene->accel = kind == ACCEL_WIDE ? build_wide(scene, &all)
                                      : build_other(scene, kind, &all);
    scene->radius = bounding_radius(&all);
    bool by_power = scene->integrator.selection == SELECT_POWER;
    scene->light_table = light_table_make(scene->lights, scene->light_count,
                                          by_power, scene->radius);
    return true;
}

/* Sets *t and the barycentric coordinates of a triangle. */
static bool test_primitive(const struct scene *scene, const struct primitive *p,
                           const ray *r, struct nearest *hit)
{
    const struct object *o = &scene->objects[p->object];
    if (o->kind == OBJECT_SPHERE)
        return sphere_intersect(&o->sphere, r, &hit->t);
    if (o->kind == OBJECT_RECT)
        return rect_intersect(&o->rect, r, &hit->t);
    struct triangle_hit found;
    if (!triangle_intersect(p->corners, r, &found))
        return false;
    hit->t = found.t;
    hit->b1 = found.b1;
    hit->b2 = found.b2;
    return true;
}

/* out is the best so far; its t is the range's end as long as there is none,
 * since the ray's own is a little beyond. */
static bool test_nearest(const void *context, uint32_t first, uint32_t count,
                         ray *r, void *out)
{
    const struct scene *scene = context;
    bool found = false;
    counters_mine.leaves_visited++;
    counters_mine.primitives_tested += count;
    for (uint32_t i = first; i < first + count; i++) {
        const struct primitive *p = &scene->primitives[i];
        struct nearest hit = {.primitive = p->number};
        if (test_primitive(scene, p, r, &hit) && nearest_offer(out, &hit, r))
            found = true;
    }
    return found;
}

static bool test_any(const void *context, uint32_t first, uint32_t count,
                     ray *r, void *out)
{
    const struct scene *scene = context;
    const struct nearest *limit = out;
    struct nearest hit;
    counters_mine.leaves_visited++;
    for (uint32_t i = first; i < first + count; i++) {
        counters_mine.primitives_tested++;
        if (test_primitive(scene, &scene->primitives[i], r, &hit) &&
            hit.t <= limit->t)
            return true;
    }
    return false;
}

/* The wide tree asks about what is no triangle of its own only, by its number,
 * and counts by itself. */
static bool test_other_nearest(const void *context, uint32_t number,
                               uint32_t count, ray *r, void *out)
{
    const struct scene *scene = context;
    const struct primitive p = {.number = number,
                                .object = primitive_object(scene, number)};
    const struct object *o = &scene->objects[p.object];
    struct nearest hit = {.primitive = number};
    (void)count;
    if (o->model != NULL)
        return wide_nearest_placed(&o->model->tree, &o->place, r, out);
    return test_primitive(scene, &p, r, &hit) && nearest_offer(out, &hit, r);
}

static bool test_other_any(const void *context, uint32_t number, uint32_t count,
                           ray *r, void *out)
{
    const struct scene *scene = context;
    const struct primitive p = {.number = number,
                                .object = primitive_object(scene, number)};
    const struct object *o = &scene->objects[p.object];
    struct nearest hit;
    (void)count;
    if (o->model != NULL)
        return wide_any_placed(&o->model->tree, &o->place, r, out);
    return test_primitive(scene, &p, r, &hit) &&
           hit.t <= ((const struct nearest *)out)->t;
}

bool scene_nearest(const struct scene *scene, const ray *r,
                   struct scene_hit *hit)
{
    ray longer = *r;
    struct nearest best = {NO_PRIMITIVE, r->t_max, 0.0f, 0.0f};
    bool wide = scene->accel.kind == ACCEL_WIDE;
    longer.t_max = a_little_beyond(r->t_max);
    if (!accel_nearest(&scene->accel, &longer,
                       wide ? test_other_nearest : test_nearest, scene, &best))
        return false;
    *hit = (struct scene_hit){best.primitive, best.t, best.b1, best.b2};
    return true;
}

const struct object *scene_object(const struct scene *scene,
                                  const struct scene_hit *hit)
{
    return &scene->objects[primitive_object(scene, hit->primitive)];
}

static void triangle_surface(const struct object *o, uint32_t triangle,
                             const struct scene_hit *hit, struct surface *out)
{
    const struct triangle_hit found = {hit->t, hit->b1, hit->b2};
    if (o->model != NULL)
        models_surface(o, triangle, &found, out);
    else
        mesh_surface(&o->mesh, triangle, &found, out);
}

void scene_surface(const struct scene *scene, const ray *r,
                   const struct scene_hit *hit, const struct object *object,
                   struct surface *out)
{
    uint32_t first = scene->first_primitive[object - scene->objects];
    switch (object->kind) {
    case OBJECT_SPHERE:
        sphere_surface(&object->sphere, r, hit->t, out);
        break;
    case OBJECT_RECT:
        rect_surface(&object->rect, r, hit->t, out);
        break;
    case OBJECT_MESH:
        triangle_surface(object, hit->primitive - first, hit, out);
        break;
    }
}

bool scene_any(const struct scene *scene, const ray *r)
{
    ray longer = *r;
    struct nearest limit = {NO_PRIMITIVE, r->t_max, 0.0f, 0.0f};
    bool wide = scene->accel.kind == ACCEL_WIDE;
    counters_mine.shadow_rays++;
    longer.t_max = a_little_beyond(r->t_max);
    return accel_any(&scene->accel, &longer, wide ? test_other_any : test_any,
                     scene, &limit);
}

bool scene_segment_blocked(const struct scene *scene, const struct surface *s,
                           vec3 point)
{
    ray r = surface_segment(s, point);
    return scene_any(scene, &r);
}

bool scene_direction_blocked(const struct scene *scene, const struct surface *s,
                             vec3 direction)
{
    ray r = surface_ray(s, direction, INFINITY);
    return scene_any(scene, &r);
}

void scene_free(struct scene *scene)
{
    for (uint32_t i = 0; i < scene->object_count; i++)
        mesh_free(&scene->objects[i].mesh);
    for (uint32_t i = 0; i < scene->texture_count; i++)
        texture_free(&scene->textures[i]);
    for (uint32_t i = 0; i < scene->light_count; i++)
        light_free(&scene->lights[i]);
    image_free(&scene->environment_image);
    light_table_free(&scene->light_table);
    models_free(scene);
    mem_free(scene->objects);
    mem_free(scene->materials);
    mem_free(scene->textures);
    mem_free(scene->lights);
    mem_free(scene->first_primitive);
    mem_free(scene->primitives);
    accel_free(&scene->accel);
}
