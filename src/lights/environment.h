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
    const struct image *image; /* owned by the scene; values >= 0 */
    float scale;               /* factor of all radiance */
    struct transform to_world; /* a rotation: local to world directions */
    struct distribution_2d table; /* owned */
};

/* Builds the table. image and its values must outlive the environment. */
struct environment environment_make(const struct image *image, float scale,
                                    struct transform to_world);

/* The radiance from a direction (unit, world, away from the scene). Bilinear
 * between texel centres; wraps in u, clamps in v. */
rgb environment_radiance(const struct environment *e, vec3 direction);

/* Picks a direction. random: two numbers in [0, 1). Returns its density per
 * steradian; 0: the pick failed (a black map). */
float environment_sample(const struct environment *e, vec2 random,
                         vec3 *direction);

/* The density with which environment_sample picks a direction, per steradian:
 * proportional to luminance, so that bright parts are picked often. The table
 * is over u and v; sin theta turns it into one over the sphere. It is above
 * zero wherever environment_radiance is. */
float environment_pdf(const struct environment *e, vec3 direction);

/* Mean luminance over the sphere. */
float environment_mean_luminance(const struct environment *e);

void environment_free(struct environment *e);

#endif
