/* views.h - debugging views: what the first hit looks like to the program. */
#ifndef RAYBOOK_INTEGRATORS_VIEWS_H
#define RAYBOOK_INTEGRATORS_VIEWS_H

#include "integrators/tracer.h"

/* What a camera ray found, as numbers; all zero on a miss but bvh_cost. */
struct first_hit {
    rgb albedo;
    vec3 normal; /* shading normal, towards the viewer's side or not */
    float depth; /* metres along the ray */
    vec2 uv;
    float bvh_cost;  /* boxes and primitives tested */
    float mip_level; /* of the material's image texture; 0 without one */
};

struct first_hit first_hit(const struct tracer *t, const ray *r,
                           const struct ray_differential *d);

/* A first hit as a colour: normal as (n + 1) / 2; depth in metres, grey; uv as
 * red and green (their fractions); bvh_cost and mip_level by a scale from blue
 * (little) over green to red (200 tests; level 8). */
rgb view_color(enum integrator_kind kind, const struct first_hit *h);

#endif
