/* light.h - where light comes from.
 *
 * A light is asked two things: to pick a direction in which a point may see it
 * (light_sample), and with what density it would have picked one that was
 * found otherwise (light_pdf). */
#ifndef RAYBOOK_LIGHTS_LIGHT_H
#define RAYBOOK_LIGHTS_LIGHT_H

#include <stdbool.h>
#include <stdint.h>

#include "base/rgb.h"
#include "base/vec.h"
#include "lights/environment.h"
#include "sampling/distribution.h"
#include "shapes/mesh.h"
#include "shapes/rect.h"
#include "shapes/sphere.h"

enum light_kind {
    LIGHT_POINT,
    LIGHT_DIRECTIONAL,
    LIGHT_SPOT,
    LIGHT_RECT,
    LIGHT_SPHERE,
    LIGHT_MESH,
    LIGHT_ENVIRONMENT
};

/* Shapes belong to the scene; what is marked owned is released by light_free.
 *
 * point: flux / 4 pi in every direction. directional: irradiance on a surface
 * that faces it, from infinitely far away. spot: intensity along its axis,
 * whole within beam_angle of it, falling evenly with the angle to nothing at
 * cutoff_angle. The area lights emit `radiance` evenly from the side
 * that the geometric normal points to, and nothing from the other. */
struct light {
    enum light_kind kind;
    vec3 position;  /* point, spot */
    vec3 direction; /* directional, spot: the way the light travels, unit */
    rgb flux;       /* point, W */
    rgb irradiance; /* directional, W m^-2 */
    rgb intensity;  /* spot, W sr^-1 */
    float beam_angle, cutoff_angle; /* spot, radians from the axis */
    rgb radiance;                   /* area lights, W m^-2 sr^-1 */
    const struct rect *rect;
    const struct sphere *sphere;
    const struct mesh *mesh;
    struct distribution_1d triangles; /* mesh: by area; owned */
    float area;                       /* mesh, rect, sphere; m^2 */
    float extent; /* no two points of the rect, of the sphere or of one of the
                     mesh's triangles are further apart; m */
    struct environment environment; /* owned */
};

/* Ties an area light of this kind to its shape, which must stay where it is
 * as long as the light is used; the mesh's table is built here. */
void light_set_rect(struct light *light, const struct rect *rect);
void light_set_sphere(struct light *light, const struct sphere *sphere);
void light_set_mesh(struct light *light, const struct mesh *mesh);

/* What a point sees of a light in one direction.
 *
 * target is the place on the light, moved off it by just more than rounding
 * may have moved it in: the straight way from a point in front to the target
 * doesn't meet the light itself. */
struct light_sample {
    vec3 direction; /* to the light, unit */
    vec3 target;    /* where the way to it ends; unused when infinite */
    bool infinite;  /* the light has no place: follow direction for ever */
    bool delta;     /* a single direction: no density; pdf is 1 */
    rgb radiance;   /* arriving; for delta lights the irradiance on a surface
                       that faces the light */
    float pdf;      /* per steradian, above 0 */
};

/* Picks a direction from point to the light. random: two numbers in [0, 1).
 * false: the point cannot see it from where it is (behind a rectangle,
 * outside a spot, inside a sphere light), or the pick carries no light. */
bool light_sample(const struct light *light, vec3 point, vec2 random,
                  struct light_sample *out);

/* The density, per steradian, with which light_sample(point) picks the
 * direction to `position` on the light with geometric normal `normal`; for
 * the environment only direction counts. 0 for delta lights. */
float light_pdf(const struct light *light, vec3 point, vec3 direction,
                vec3 position, vec3 normal);

/* The radiance that an area light sends along `outgoing` (away from it, of any
 * length) from a place with this geometric normal; black on its back, and for
 * other kinds of light. */
rgb light_emitted(const struct light *light, vec3 normal, vec3 outgoing);

/* Is it a light without extent, which a ray can't hit? */
bool light_is_delta(const struct light *light);

/* An estimate of all the power that the light gives a scene that lies in a
 * sphere of this radius (m), as luminance in W: for picking one of many. */
float light_power(const struct light *light, float scene_radius);

void light_free(struct light *light);

#endif
