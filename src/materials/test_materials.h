/* test_materials.h - for tests: surfaces, colours and directions to try. */
#ifndef RAYBOOK_MATERIALS_TEST_MATERIALS_H
#define RAYBOOK_MATERIALS_TEST_MATERIALS_H

#include "materials/material.h"
#include "sampling/random.h"
#include "sampling/warp.h"

static inline struct texture constant_texture(rgb color)
{
    struct texture t = {.kind = TEXTURE_CONSTANT, .color = {color, color}};
    t.scale = vec2_make(1.0f, 1.0f);
    return t;
}

static inline vec3 unit(float x, float y, float z)
{
    return vec3_normalize(vec3_make(x, y, z));
}

/* Number i of a fixed list of directions all around. */
static inline vec3 some_direction(uint64_t i)
{
    return warp_sphere(vec2_make(random_float(i, 0), random_float(i, 1)));
}

/* u does not run at right angles to the normals, nor is it of length one. */
static inline struct surface surface_with(vec3 geometric, vec3 shading)
{
    struct surface s = {.geometric_normal = geometric,
                        .shading_normal = shading};
    vec3 x, y;
    vec3_frame(geometric, &x, &y);
    s.dp_du = vec3_add(vec3_scale(x, 2.5f), vec3_scale(y, 0.8f));
    s.dp_dv = vec3_scale(y, -0.4f);
    return s;
}

/* Lies askew in space; both normals are the same. */
static inline struct surface flat_surface(void)
{
    vec3 n = unit(0.3f, -0.5f, 0.7f);
    return surface_with(n, n);
}

/* As near the rim of a coarse mesh: the normals are 30 degrees apart. */
static inline struct surface smooth_surface(void)
{
    vec3 n = unit(0.3f, -0.5f, 0.7f), x, y;
    vec3_frame(n, &x, &y);
    return surface_with(n, vec3_normalize(vec3_step(n, 0.577f, x)));
}

/* The direction at an angle (radians) to the shading normal, turned by phi
 * about it. */
static inline vec3 direction_at(const struct surface *s, float angle, float phi)
{
    vec3 x, y, n = s->shading_normal;
    vec3_frame(n, &x, &y);
    vec3 side = vec3_add(vec3_scale(x, cosf(phi)), vec3_scale(y, sinf(phi)));
    return vec3_normalize(
        vec3_add(vec3_scale(side, sinf(angle)), vec3_scale(n, cosf(angle))));
}

#endif
