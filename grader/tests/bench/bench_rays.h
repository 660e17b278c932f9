/* bench_rays.h - three kinds of rays, as a renderer would ask them.
 *
 *     primary  from the camera through the pixels, row by row
 *     bounce   from where those hit, over the hemisphere by its cosine
 *     shadow   from where those hit, to a point of the lamp
 *
 * The first two ask for the nearest hit, the last whether there is any. The
 * rays are made once, and everything that is measured casts the same. */
#ifndef RAYBOOK_BENCH_RAYS_H
#define RAYBOOK_BENCH_RAYS_H

#include <stddef.h>

#include "base/ray.h"
#include "bench_mesh.h"

enum ray_kind { RAYS_PRIMARY, RAYS_BOUNCE, RAYS_SHADOW, RAY_KINDS };

/* In the order of enum ray_kind. */
extern const char *const ray_kind_names[RAY_KINDS];

/* Without the inverse direction: what a tracer computes from a ray is part of
 * its time. */
struct bench_ray {
    vec3 origin;
    float t_min;
    vec3 direction;
    float t_max;
};

/* `count` rays of each kind. */
struct bench_rays {
    struct bench_ray *rays[RAY_KINDS];
    size_t count;
};

/* The mesh must be in view. Release with bench_rays_free. */
struct bench_rays bench_rays_make(const struct bench_mesh *b, size_t count);

void bench_rays_free(struct bench_rays *r);

#endif
