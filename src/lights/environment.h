/* environment.h - assignment 09: light from everywhere around.
 *
 * An image of the whole sphere of directions: in the light's own frame, with
 * the pole at +z, a direction has azimuth phi (from +x towards +y) and polar
 * angle theta (from +z); u = phi / 2 pi, v = theta / pi, and row 0 of the image
 * is theta = 0. */
#ifndef RAYBOOK_LIGHTS_ENVIRONMENT_H
#define RAYBOOK_LIGHTS_ENVIRONMENT_H

#include <stdbool.h>

#include "base/rgb.h"
#include "base/transform.h"
#include "image/image.h"
#include "sampling/distribution.h"

struct environment {
    const struct image *image;    /* owned by the scene; values >= 0 */
    float scale;                  /* factor of all radiance, >= 0 */
    struct transform to_world;    /* a rotation: local to world directions */
    struct distribution_2d table; /* owned */
};

/* Builds the table. image and its values must outlive the environment. */
struct environment environment_make(const struct image *image, float scale,
                                    struct transform to_world);

/* The radiance from a direction (unit, world, away from the scene). Bilinear
 * between texel centres, which lie at half integers; wraps in u, clamps in v.
 */
rgb environment_radiance(const struct environment *e, vec3 direction);

/* Picks a direction (unit, world). random: two numbers in [0, 1). Returns its
 * density per steradian, which is what environment_pdf says of it; 0: the pick
 * failed (a black map). */
float environment_sample(const struct environment *e, vec2 random,
                         vec3 *direction);

/* The density with which environment_sample picks a direction, per steradian.
 *
 * - It follows the luminance, so that bright parts are picked often.
 * - It is above zero wherever the radiance is, also where a bright texel only
 *   shines into its neighbours by the bilinear blend: light that is never
 *   picked is lost.
 * - It is a density over the sphere, not over u and v: a row of the image near
 *   a pole is as wide as any other, but covers few directions.
 * - It integrates to one over the sphere (a black map: 0 everywhere). */
float environment_pdf(const struct environment *e, vec3 direction);

/* Mean luminance over the sphere, W m^-2 sr^-1. */
float environment_mean_luminance(const struct environment *e);

void environment_free(struct environment *e);

#endif
