/* hits.c - do all accelerators find the same hits, and does a mesh leak?
 *
 *     hits MESH.obj INSIDE.txt RAYS SEED LINEAR_RAYS
 *
 * Casts so many rays at the mesh through the BVH, the wide tree and, if it is
 * there, Embree, the first LINEAR_RAYS of them also by testing everything, and prints counts
 * as one JSON object. Four kinds of rays take turns: between random points,
 * from a random point to a vertex, from a random point to a point of an edge,
 * and to a random point. INSIDE.txt (perhaps empty) lists points, x y z,
 * inside a closed mesh; if there are any, every second ray starts at one of
 * them, and as a closed mesh leaks no ray, each of those must hit.
 *
 * Two answers agree when both miss or both hit the same triangle at a t of the
 * same bits. A few of the rays that disagree are told on standard error. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "sampling/random.h"
#include "scene/obj_reader.h"
#include "scene/scene.h"

enum { MOST_TOLD = 5 };

struct world {
    struct mesh mesh;
    aabb box;
    vec3 *inside;
    size_t inside_count;
    struct scene bvh, wide, linear, embree;
    bool has_embree;
};

struct counts {
    uint64_t hits, wide_differs, linear_differs, embree_differs;
    uint64_t any_differs; /* between the BVH's nearest hit and anyone's any */
    uint64_t from_inside, leaks;
};

/* Setting up -------------------------------------------------------------- */

static void stop(const char *path, const char *what)
{
    fprintf(stderr, "hits: %s: %s\n", path, what);
    exit(2);
}

static void read_inside(struct world *w, const char *path)
{
    vec3 p;
    FILE *file = fopen(path, "r");
    if (file == NULL)
        stop(path, "cannot be opened");
    while (fscanf(file, "%f %f %f", &p.x, &p.y, &p.z) == 3) {
        w->inside =
            mem_resize(w->inside, w->inside_count + 1, sizeof *w->inside);
        w->inside[w->inside_count++] = p;
    }
    fclose(file);
}

static struct scene make_scene(struct world *w, enum accel_kind kind)
{
    struct scene scene;
    struct error err = {""};
    memset(&scene, 0, sizeof scene);
    scene.environment = -1;
    scene.objects = mem_alloc(1, sizeof *scene.objects);
    scene.objects->kind = OBJECT_MESH;
    scene.objects->mesh = w->mesh; /* stays ours */
    scene.objects->light = -1;
    scene.object_count = 1;
    if (!scene_prepare(&scene, kind, &err))
        stop("scene", err.text);
    return scene;
}

static void make_world(struct world *w, const char *mesh, const char *inside)
{
    struct error err = {""};
    memset(w, 0, sizeof *w);
    if (!obj_read(mesh, &w->mesh, &err))
        stop(mesh, err.text);
    w->box = aabb_empty();
    for (uint32_t i = 0; i < w->mesh.vertex_count; i++)
        w->box = aabb_include(w->box, w->mesh.positions[i]);
    read_inside(w, inside);
    w->bvh = make_scene(w, ACCEL_BVH);
    w->wide = make_scene(w, ACCEL_WIDE);
    w->linear = make_scene(w, ACCEL_LINEAR);
    w->has_embree = accel_available(ACCEL_EMBREE);
    if (w->has_embree)
        w->embree = make_scene(w, ACCEL_EMBREE);
}

/* Rays -------------------------------------------------------------------- */

/* In the mesh's box, made larger about its centre. */
static vec3 random_point(const struct world *w, uint64_t key, uint32_t first,
                         float larger)
{
    vec3 size = vec3_sub(w->box.upper, w->box.lower);
    vec3 at = vec3_make(random_float(key, first) - 0.5f,
                        random_float(key, first + 1) - 0.5f,
                        random_float(key, first + 2) - 0.5f);
    vec3 centre = aabb_centroid(w->box);
    return vec3_make(centre.x + larger * size.x * at.x,
                     centre.y + larger * size.y * at.y,
                     centre.z + larger * size.z * at.z);
}

/* Where the ray is aimed at: the four kinds. */
static vec3 target(const struct world *w, uint64_t key, uint64_t kind)
{
    uint32_t triangle = random_bits(key, 8) % w->mesh.triangle_count;
    uint32_t corner = random_bits(key, 9) % 3;
    vec3 p[3];
    mesh_corners(&w->mesh, triangle, p);
    vec3 a = p[corner], b = p[(corner + 1) % 3];
    if (kind == 1)
        return a;
    if (kind == 2)
        return vec3_step(a, random_float(key, 10), vec3_sub(b, a));
    return random_point(w, key, 12, kind == 3 ? 1.0f : 1.5f);
}

static bool starts_inside(const struct world *w, uint64_t index)
{
    return w->inside_count > 0 && index % 2 == 1;
}

/* As if it left a surface that is known exactly, so that it can be asked about
 * in all ways. */
static struct surface make_start(vec3 from)
{
    struct surface s;
    memset(&s, 0, sizeof s);
    s.position = from;
    return s;
}

/* Returns its direction. */
static vec3 make_ray(const struct world *w, uint64_t seed, uint64_t index,
                     struct surface *start)
{
    uint64_t key = random_key(seed, index, 0);
    vec3 from = random_point(w, key, 0, 3.0f);
    if (starts_inside(w, index))
        from = w->inside[random_bits(key, 4) % w->inside_count];
    *start = make_start(from);
    return vec3_sub(target(w, key, index / 2 % 4), from);
}

/* Comparing --------------------------------------------------------------- */

static void tell(const char *what, uint64_t index, const ray *r,
                 const struct scene_hit *a, const struct scene_hit *b)
{
    static int told;
    if (told++ < MOST_TOLD)
        fprintf(stderr,
                "ray %" PRIu64 ", %s: origin %a %a %a direction %a %a %a: "
                "t %a triangle %u, t %a triangle %u\n",
                index, what, (double)r->origin.x, (double)r->origin.y,
                (double)r->origin.z, (double)r->direction.x,
                (double)r->direction.y, (double)r->direction.z, (double)a->t,
                (unsigned)a->primitive, (double)b->t, (unsigned)b->primitive);
}

/* The nearest hit; on a miss t is infinite. */
static struct scene_hit nearest(const struct scene *s, const ray *r)
{
    struct scene_hit hit = {UINT32_MAX, INFINITY, 0.0f, 0.0f};
    scene_nearest(s, r, &hit);
    return hit;
}

static bool agree(const struct scene_hit *a, const struct scene_hit *b)
{
    return a->t == b->t && a->b1 == b->b1 && a->b2 == b->b2 &&
           a->primitive == b->primitive;
}

/* Asks one of the other structures what the BVH was asked. */
static void compare(const struct scene *other, const char *name,
                    const struct surface *start, const ray *r, uint64_t index,
                    const struct scene_hit *hit, uint64_t *differs,
                    struct counts *c)
{
    struct scene_hit found = nearest(other, r);
    if (!agree(hit, &found)) {
        (*differs)++;
        tell(name, index, r, hit, &found);
    }
    if (scene_direction_blocked(other, start, r->direction) !=
        (hit->t < INFINITY)) {
        c->any_differs++;
        tell("any", index, r, hit, hit);
    }
}

static void cast(const struct world *w, uint64_t seed, uint64_t index,
                 bool linear_too, struct counts *c)
{
    struct surface start;
    vec3 direction = make_ray(w, seed, index, &start);
    ray r = surface_ray(&start, direction, INFINITY);
    struct scene_hit hit = nearest(&w->bvh, &r);
    uint64_t none = 0;
    c->hits += hit.t < INFINITY;
    compare(&w->bvh, "bvh", &start, &r, index, &hit, &none, c);
    compare(&w->wide, "wide", &start, &r, index, &hit, &c->wide_differs, c);
    if (linear_too)
        compare(&w->linear, "linear", &start, &r, index, &hit,
                &c->linear_differs, c);
    if (w->has_embree)
        compare(&w->embree, "embree", &start, &r, index, &hit,
                &c->embree_differs, c);
    if (!starts_inside(w, index))
        return;
    c->from_inside++;
    if (hit.t == INFINITY) {
        c->leaks++;
        tell("leak", index, &r, &hit, &hit);
    }
}

static void print(const struct world *w, uint64_t rays, uint64_t linear_rays,
                  const struct counts *c)
{
    printf("{\"triangles\": %u, \"rays\": %" PRIu64
           ", \"linear_rays\": %" PRIu64 ", \"embree\": %s, \"hits\": %" PRIu64
           ", \"wide_differs\": %" PRIu64 ", \"linear_differs\": %" PRIu64
           ", \"embree_differs\": %" PRIu64 ", \"any_differs\": %" PRIu64
           ", \"from_inside\": %" PRIu64 ", \"leaks\": %" PRIu64 "}\n",
           (unsigned)w->mesh.triangle_count, rays, linear_rays,
           w->has_embree ? "true" : "false", c->hits, c->wide_differs,
           c->linear_differs, c->embree_differs, c->any_differs, c->from_inside,
           c->leaks);
}

int main(int argc, char *argv[])
{
    struct world w;
    struct counts c = {0};
    if (argc != 6)
        stop("usage", "hits MESH.obj INSIDE.txt RAYS SEED LINEAR_RAYS");
    make_world(&w, argv[1], argv[2]);
    uint64_t rays = strtoull(argv[3], NULL, 10);
    uint64_t seed = strtoull(argv[4], NULL, 10);
    uint64_t linear_rays = strtoull(argv[5], NULL, 10);
    for (uint64_t i = 0; i < rays; i++)
        cast(&w, seed, i, i < linear_rays, &c);
    print(&w, rays, linear_rays, &c);
    return 0;
}
