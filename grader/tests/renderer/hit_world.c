/* hit_world.c - see hit_world.h. */
#include "hit_world.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "sampling/random.h"
#include "scene/models.h"
#include "scene/obj_reader.h"

enum { OF_PLACES = 77 }; /* the seed */

void hit_stop(const char *what, const char *why)
{
    fprintf(stderr, "%s: %s\n", what, why);
    exit(2);
}

/* Places ------------------------------------------------------------------ */

static vec3 normalized(vec3 v)
{
    return vec3_scale(v, 1.0f / vec3_length(v));
}

static vec3 random_vec(uint64_t key, uint32_t first)
{
    return vec3_make(random_float(key, first) - 0.5f,
                     random_float(key, first + 1) - 0.5f,
                     random_float(key, first + 2) - 0.5f);
}

/* Three axes at right angles, each of a length from .3 to 1.3, two of three
 * times mirrored or not; every fourth place is upright and whole-numbered,
 * so that surfaces touch. */
static struct transform place_of(const struct hit_world *w, uint32_t index)
{
    uint64_t key = random_key(OF_PLACES, index, 0);
    struct transform t = transform_identity();
    vec3 axis[3];
    axis[0] = normalized(random_vec(key, 0));
    axis[1] = normalized(vec3_cross(axis[0], random_vec(key, 3)));
    axis[2] = vec3_cross(axis[0], axis[1]);
    float rows[16] = {0};
    for (int i = 0; i < 3; i++) {
        float size = 0.3f + random_float(key, 6 + (uint32_t)i);
        size = random_bits(key, 9 + (uint32_t)i) % 3 == 0 ? -size : size;
        for (int k = 0; k < 3; k++)
            rows[4 * k + i] = size * vec3_axis(axis[i], k);
    }
    rows[15] = 1.0f;
    if (index % 4 != 3 && !transform_from_rows(rows, &t))
        hit_stop("place", "a flat map");
    vec3 offset =
        vec3_scale(random_vec(key, 12), 4.0f * cbrtf((float)w->places));
    if (index % 4 == 3)
        offset = vec3_make(rintf(offset.x), rintf(offset.y), rintf(offset.z));
    return transform_translated(t, offset);
}

static vec3 into_world(const struct hit_world *w, uint32_t index, vec3 p)
{
    if (w->places == 0)
        return p;
    struct transform t = place_of(w, index);
    return transform_point(&t, p);
}

static uint32_t random_place(const struct hit_world *w, uint64_t key,
                             uint32_t number)
{
    return w->places > 0 ? random_bits(key, number) % w->places : 0;
}

/* Setting up -------------------------------------------------------------- */

static void read_inside(struct hit_world *w, const char *path)
{
    vec3 p;
    FILE *file = fopen(path, "r");
    if (file == NULL)
        hit_stop(path, "cannot be opened");
    while (fscanf(file, "%f %f %f", &p.x, &p.y, &p.z) == 3) {
        w->inside =
            mem_resize(w->inside, w->inside_count + 1, sizeof *w->inside);
        w->inside[w->inside_count++] = p;
    }
    fclose(file);
}

static aabb box_of(const struct hit_world *w)
{
    aabb box = aabb_empty();
    uint32_t last = w->places > 0 ? w->places - 1 : 0;
    for (uint32_t place = 0; place <= last; place++)
        for (uint32_t i = 0; i<w->mesh.vertex_count; i += w->places> 0 ? 7 : 1)
            box = aabb_include(box, into_world(w, place, w->mesh.positions[i]));
    return box;
}

struct hit_world hit_world_read(const char *mesh, const char *inside,
                                uint32_t places)
{
    struct hit_world w;
    struct error err = {""};
    memset(&w, 0, sizeof w);
    w.path = mesh;
    w.places = places;
    if (!obj_read(mesh, &w.mesh, &err))
        hit_stop(mesh, err.text);
    read_inside(&w, inside);
    w.box = box_of(&w);
    return w;
}

static void show(const struct hit_world *w, struct scene *scene)
{
    struct error err = {""};
    struct model *model = models_find(scene, w->path, &err);
    if (model == NULL)
        hit_stop(w->path, err.text);
    for (uint32_t i = 0; i < w->places; i++) {
        struct transform t = place_of(w, i);
        models_show(model, &t, &scene->objects[i]);
    }
}

struct scene hit_world_scene(const struct hit_world *w, enum accel_kind kind)
{
    struct scene scene;
    struct error err = {""};
    memset(&scene, 0, sizeof scene);
    scene.environment = -1;
    scene.object_count = w->places > 0 ? w->places : 1;
    scene.objects = mem_alloc(scene.object_count, sizeof *scene.objects);
    scene.models = mem_alloc(1, sizeof *scene.models);
    for (uint32_t i = 0; i < scene.object_count; i++) {
        scene.objects[i].kind = OBJECT_MESH;
        scene.objects[i].light = -1;
    }
    if (w->places > 0)
        show(w, &scene);
    else
        scene.objects->mesh = w->mesh; /* stays ours */
    if (!scene_prepare(&scene, kind, &err))
        hit_stop("scene", err.text);
    return scene;
}

/* Rays -------------------------------------------------------------------- */

/* In the world's box, made larger about its centre. */
static vec3 random_point(const struct hit_world *w, uint64_t key,
                         uint32_t first, float larger)
{
    vec3 size = vec3_sub(w->box.upper, w->box.lower);
    vec3 at = random_vec(key, first);
    vec3 centre = aabb_centroid(w->box);
    return vec3_make(centre.x + larger * size.x * at.x,
                     centre.y + larger * size.y * at.y,
                     centre.z + larger * size.z * at.z);
}

/* Where the ray is aimed at: the four kinds. */
static vec3 target(const struct hit_world *w, uint64_t key, uint64_t kind)
{
    uint32_t triangle = random_bits(key, 8) % w->mesh.triangle_count;
    uint32_t corner = random_bits(key, 9) % 3;
    uint32_t place = random_place(w, key, 15);
    vec3 p[3];
    mesh_corners(&w->mesh, triangle, p);
    vec3 a = into_world(w, place, p[corner]);
    vec3 b = into_world(w, place, p[(corner + 1) % 3]);
    if (kind == 1)
        return a;
    if (kind == 2)
        return vec3_step(a, random_float(key, 10), vec3_sub(b, a));
    return random_point(w, key, 12, kind == 3 ? 1.0f : 1.5f);
}

bool hit_world_starts_inside(const struct hit_world *w, uint64_t index)
{
    return w->inside_count > 0 && index % 2 == 1;
}

static struct surface make_start(vec3 from)
{
    struct surface s;
    memset(&s, 0, sizeof s);
    s.position = from;
    return s;
}

vec3 hit_world_ray(const struct hit_world *w, uint64_t seed, uint64_t index,
                   struct surface *start)
{
    uint64_t key = random_key(seed, index, 0);
    vec3 from = random_point(w, key, 0, 3.0f);
    if (hit_world_starts_inside(w, index))
        from = into_world(w, random_place(w, key, 16),
                          w->inside[random_bits(key, 4) % w->inside_count]);
    *start = make_start(from);
    return vec3_sub(target(w, key, index / 2 % 4), from);
}
