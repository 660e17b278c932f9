/* scene.c - what a ray hits in a scene; see scene.h. */
#include "scene/scene.h"

#include "base/memory.h"

static uint64_t count_primitives(const struct scene *scene)
{
    uint64_t count = 0;
    for (uint32_t i = 0; i < scene->object_count; i++) {
        const struct object *o = &scene->objects[i];
        count += o->kind == OBJECT_MESH ? o->mesh.triangle_count : 1;
    }
    return count;
}

/* The primitives in the order of the scene file. */
static void list_primitives(const struct scene *scene, struct primitive *list)
{
    for (uint32_t i = 0; i < scene->object_count; i++) {
        const struct object *o = &scene->objects[i];
        uint32_t count = o->kind == OBJECT_MESH ? o->mesh.triangle_count : 1;
        for (uint32_t k = 0; k < count; k++, list++) {
            list->object = i;
            list->triangle = k;
            if (o->kind == OBJECT_MESH)
                mesh_corners(&o->mesh, k, list->corners);
        }
    }
}

static aabb primitive_box(const struct scene *scene, const struct primitive *p)
{
    const struct object *o = &scene->objects[p->object];
    if (o->kind == OBJECT_SPHERE)
        return sphere_bounds(&o->sphere);
    if (o->kind == OBJECT_RECT)
        return rect_bounds(&o->rect);
    aabb box = aabb_include(aabb_empty(), p->corners[0]);
    return aabb_include(aabb_include(box, p->corners[1]), p->corners[2]);
}

static void build(struct scene *scene, enum accel_kind kind,
                  const struct primitive *listed)
{
    uint32_t count = scene->primitive_count;
    aabb *boxes = mem_alloc(count, sizeof *boxes);
    uint32_t *order = mem_alloc(count, sizeof *order);
    for (uint32_t i = 0; i < count; i++)
        boxes[i] = primitive_box(scene, &listed[i]);
    scene->accel = accel_build(kind, boxes, count, order);
    scene->primitives = mem_alloc(count, sizeof *scene->primitives);
    for (uint32_t i = 0; i < count; i++)
        scene->primitives[i] = listed[order[i]];
    mem_free(boxes);
    mem_free(order);
}

/* The radius of a sphere around the box of everything; at least a little, so
 * that an empty scene's lights have a power. */
static float bounding_radius(const struct scene *scene,
                             const struct primitive *listed)
{
    aabb box = aabb_empty();
    for (uint32_t i = 0; i < scene->primitive_count; i++)
        box = aabb_union(box, primitive_box(scene, &listed[i]));
    float radius = 0.5f * vec3_length(vec3_sub(box.upper, box.lower));
    return isfinite(radius) && radius > 0.0f ? radius : 1.0f;
}

bool scene_prepare(struct scene *scene, enum accel_kind kind, struct error *err)
{
    uint64_t count = count_primitives(scene);
    if (count > UINT32_MAX / 2)
        return error_set(err, "%llu primitives are more than %u",
                         (unsigned long long)count, UINT32_MAX / 2);
    scene->primitive_count = (uint32_t)count;
    struct primitive *listed = mem_alloc(count, sizeof *listed);
    list_primitives(scene, listed);
    build(scene, kind, listed);
    scene->radius = bounding_radius(scene, listed);
    mem_free(listed);
    bool by_power = scene->integrator.selection == SELECT_POWER;
    scene->light_table = light_table_make(scene->lights, scene->light_count,
                                          by_power, scene->radius);
    return true;
}

#define NO_PRIMITIVE UINT32_MAX

static bool test_primitive(const struct scene *scene, uint32_t index,
                           const ray *r, struct scene_hit *hit)
{
    const struct primitive *p = &scene->primitives[index];
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

/* Is hit a at least as near as b? Where several primitives meet, the first of
 * the file is the one that is hit: the answer must not depend on the order in
 * which a structure asks. */
static bool comes_first(const struct scene *scene, const struct scene_hit *a,
                        const struct scene_hit *b)
{
    if (a->t != b->t || b->primitive == NO_PRIMITIVE)
        return a->t <= b->t;
    const struct primitive *p = &scene->primitives[a->primitive];
    const struct primitive *q = &scene->primitives[b->primitive];
    return p->object < q->object ||
           (p->object == q->object && p->triangle < q->triangle);
}

/* Boxes and primitives round differently. A structure that is told to look a
 * little further than the nearest hit does not pass over a box in which a hit
 * of the same t lies. */
static float a_little_beyond(float t)
{
    return t * (1.0f + 0x1p-20f);
}

/* out is the best so far; its t is the range's end as long as there is none,
 * since the ray's own is a little beyond. */
static bool test_nearest(const void *context, uint32_t first, uint32_t count,
                         ray *r, void *out)
{
    struct scene_hit *best = out, hit;
    bool found = false;
    counters_mine.leaves_visited++;
    counters_mine.primitives_tested += count;
    for (hit.primitive = first; hit.primitive < first + count;
         hit.primitive++) {
        if (!test_primitive(context, hit.primitive, r, &hit) ||
            !comes_first(context, &hit, best))
            continue;
        *best = hit;
        r->t_max = a_little_beyond(hit.t);
        found = true;
    }
    return found;
}

static bool test_any(const void *context, uint32_t first, uint32_t count,
                     ray *r, void *out)
{
    const struct scene_hit *limit = out;
    struct scene_hit hit;
    counters_mine.leaves_visited++;
    for (uint32_t i = first; i < first + count; i++) {
        counters_mine.primitives_tested++;
        if (test_primitive(context, i, r, &hit) && hit.t <= limit->t)
            return true;
    }
    return false;
}

bool scene_nearest(const struct scene *scene, const ray *r,
                   struct scene_hit *hit)
{
    ray longer = *r;
    struct scene_hit best = {NO_PRIMITIVE, r->t_max, 0.0f, 0.0f};
    longer.t_max = a_little_beyond(r->t_max);
    if (!accel_nearest(&scene->accel, &longer, test_nearest, scene, &best))
        return false;
    *hit = best;
    return true;
}

struct surface scene_surface(const struct scene *scene, const ray *r,
                             const struct scene_hit *hit,
                             const struct object **object)
{
    const struct primitive *p = &scene->primitives[hit->primitive];
    const struct object *o = &scene->objects[p->object];
    *object = o;
    if (o->kind == OBJECT_SPHERE)
        return sphere_surface(&o->sphere, r, hit->t);
    if (o->kind == OBJECT_RECT)
        return rect_surface(&o->rect, r, hit->t);
    struct triangle_hit found = {hit->t, hit->b1, hit->b2};
    return mesh_surface(&o->mesh, p->triangle, &found);
}

bool scene_any(const struct scene *scene, const ray *r)
{
    ray longer = *r;
    struct scene_hit limit = {NO_PRIMITIVE, r->t_max, 0.0f, 0.0f};
    counters_mine.shadow_rays++;
    longer.t_max = a_little_beyond(r->t_max);
    return accel_any(&scene->accel, &longer, test_any, scene, &limit);
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
    mem_free(scene->objects);
    mem_free(scene->materials);
    mem_free(scene->textures);
    mem_free(scene->lights);
    mem_free(scene->primitives);
    accel_free(&scene->accel);
}
