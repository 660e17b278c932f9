/* hits.c - do all accelerators find the same hits, and does a mesh leak?
 *
 *     hits MESH.obj INSIDE.txt RAYS SEED LINEAR_RAYS PLACES
 *
 * Casts so many rays at the mesh (hit_world.h) through the BVH, the wide tree and, if it is
 * there, Embree, the first LINEAR_RAYS of them also by testing everything, and prints counts
 * as one JSON object. INSIDE.txt (perhaps empty) lists points, x y z, inside a
 * closed mesh; as such a mesh leaks no ray, each ray that starts there must
 * hit.
 *
 * Two answers agree when both miss or both hit the same triangle at a t of the
 * same bits. A few of the rays that disagree are told on standard error. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "hit_world.h"

enum { MOST_TOLD = 5 };

struct world {
    struct hit_world made;
    struct scene bvh, wide, linear, embree;
    bool has_embree;
};

struct counts {
    uint64_t hits, wide_differs, linear_differs, embree_differs;
    uint64_t any_differs; /* between the BVH's nearest hit and anyone's any */
    uint64_t from_inside, leaks;
};

static void make_world(struct world *w, const char *mesh, const char *inside,
                       uint32_t places)
{
    memset(w, 0, sizeof *w);
    w->made = hit_world_read(mesh, inside, places);
    w->bvh = hit_world_scene(&w->made, ACCEL_BVH);
    w->wide = hit_world_scene(&w->made, ACCEL_WIDE);
    w->linear = hit_world_scene(&w->made, ACCEL_LINEAR);
    w->has_embree = accel_available(ACCEL_EMBREE);
    if (w->has_embree)
        w->embree = hit_world_scene(&w->made, ACCEL_EMBREE);
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
    vec3 direction = hit_world_ray(&w->made, seed, index, &start);
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
    if (!hit_world_starts_inside(&w->made, index))
        return;
    c->from_inside++;
    if (hit.t == INFINITY) {
        c->leaks++;
        tell("leak", index, &r, &hit, &hit);
    }
}

/* The objects that show a model. */
static uint32_t placed(const struct scene *scene)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < scene->object_count; i++)
        count += scene->objects[i].model != NULL;
    return count;
}

static void print(const struct world *w, uint64_t rays, uint64_t linear_rays,
                  const struct counts *c)
{
    printf("{\"triangles\": %u, \"rays\": %" PRIu64
           ", \"placed\": %u, \"linear_rays\": %" PRIu64
           ", \"embree\": %s, \"hits\": %" PRIu64 ", \"wide_differs\": %" PRIu64
           ", \"linear_differs\": %" PRIu64 ", \"embree_differs\": %" PRIu64
           ", \"any_differs\": %" PRIu64 ", \"from_inside\": %" PRIu64
           ", \"leaks\": %" PRIu64 "}\n",
           (unsigned)w->wide.primitive_count, rays, (unsigned)placed(&w->wide),
           linear_rays, w->has_embree ? "true" : "false", c->hits,
           c->wide_differs, c->linear_differs, c->embree_differs,
           c->any_differs, c->from_inside, c->leaks);
}

int main(int argc, char *argv[])
{
    struct world w;
    struct counts c = {0};
    if (argc > 1 && strcmp(argv[1], "leaks") == 0)
        return leaks(argc - 1, argv + 1);
    if (argc != 7)
        hit_stop("usage",
                 "hits MESH.obj INSIDE.txt RAYS SEED LINEAR_RAYS PLACES");
    make_world(&w, argv[1], argv[2], (uint32_t)strtoul(argv[6], NULL, 10));
    uint64_t rays = strtoull(argv[3], NULL, 10);
    uint64_t seed = strtoull(argv[4], NULL, 10);
    uint64_t linear_rays = strtoull(argv[5], NULL, 10);
    for (uint64_t i = 0; i < rays; i++)
        cast(&w, seed, i, i < linear_rays, &c);
    print(&w, rays, linear_rays, &c);
    return 0;
}
