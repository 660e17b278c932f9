/* bench_rays.c - see bench_rays.h. */
#include "bench_rays.h"

#include <stdio.h>
#include <stdlib.h>

#include "base/memory.h"
#include "bench_scene.h"
#include "camera/camera.h"
#include "sampling/random.h"
#include "sampling/warp.h"

const char *const ray_kind_names[RAY_KINDS] = {"primary", "bounce", "shadow"};

enum { MOST_PASSES = 64, SEED = 1 };

struct maker {
    const struct bench_mesh *mesh;
    struct scene scene;
    struct camera camera;
    int side; /* the picture is a square of so many pixels */
    struct bench_rays *out;
    size_t made[RAY_KINDS];
};

static void keep(struct maker *m, enum ray_kind kind, const ray *r)
{
    if (m->made[kind] < m->out->count)
        m->out->rays[kind][m->made[kind]++] =
            (struct bench_ray){r->origin, r->t_min, r->direction, r->t_max};
}

static vec2 random_pair(uint64_t key, uint32_t first)
{
    return vec2_make(random_float(key, first), random_float(key, first + 1));
}

static ray bounce_ray(const struct surface *s, vec3 towards, vec2 random)
{
    vec3 n = s->geometric_normal, across, up;
    if (vec3_dot(n, towards) > 0.0f)
        n = vec3_negate(n);
    vec3_frame(n, &across, &up);
    vec3 d = warp_cosine_hemisphere(random);
    vec3 direction = vec3_step(vec3_scale(across, d.x), d.y, up);
    return surface_ray(s, vec3_step(direction, d.z, n), INFINITY);
}

static ray shadow_ray(const struct bench_mesh *b, const struct surface *s,
                      vec2 random)
{
    vec3 point = vec3_step(b->lamp, random.x, b->lamp_u);
    return surface_segment(s, vec3_step(point, random.y, b->lamp_v));
}

static void make_for_pixel(struct maker *m, int x, int y, uint64_t key)
{
    vec2 in_pixel = random_pair(key, 0);
    ray r = camera_ray(&m->camera,
                       vec2_make((float)x + in_pixel.x, (float)y + in_pixel.y));
    struct scene_hit hit;
    keep(m, RAYS_PRIMARY, &r);
    if (!scene_nearest(&m->scene, &r, &hit))
        return;
    struct surface s;
    scene_surface(&m->scene, &r, &hit, scene_object(&m->scene, &hit), &s);
    ray bounce = bounce_ray(&s, r.direction, random_pair(key, 2));
    ray shadow = shadow_ray(m->mesh, &s, random_pair(key, 4));
    keep(m, RAYS_BOUNCE, &bounce);
    keep(m, RAYS_SHADOW, &shadow);
}

/* Once over all pixels; returns whether rays are still missing. */
static bool make_pass(struct maker *m, uint64_t pass)
{
    for (int y = 0; y < m->side; y++)
        for (int x = 0; x < m->side; x++) {
            uint64_t pixel = (uint64_t)y * (uint64_t)m->side + (uint64_t)x;
            make_for_pixel(m, x, y, random_key(SEED, pixel, pass));
        }
    return m->made[RAYS_PRIMARY] < m->out->count ||
           m->made[RAYS_BOUNCE] < m->out->count;
}

struct bench_rays bench_rays_make(const struct bench_mesh *b, size_t count)
{
    struct bench_rays out = {{NULL, NULL, NULL}, count};
    struct maker m = {.mesh = b, .out = &out};
    m.side = (int)ceil(sqrt((double)count));
    struct film_settings film = {.width = m.side, .height = m.side};
    m.camera = camera_make(&b->camera, &film);
    m.scene = bench_scene_make(&b->mesh, bench_accel_best());
    for (int kind = 0; kind < RAY_KINDS; kind++)
        out.rays[kind] = mem_alloc(count, sizeof *out.rays[kind]);
    uint64_t pass = 0;
    while (make_pass(&m, pass))
        if (++pass == MOST_PASSES) {
            fprintf(stderr, "bench: the camera does not see the mesh\n");
            exit(EXIT_FAILURE);
        }
    bench_scene_free(&m.scene);
    return out;
}

void bench_rays_free(struct bench_rays *r)
{
    for (int kind = 0; kind < RAY_KINDS; kind++)
        mem_free(r->rays[kind]);
}
