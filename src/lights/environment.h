/* environment.h - assignment 09: light from everywhere around.
 *
 * An image of the whole sphere of directions. In the light's own frame, with
 * the pole at +z, a direction has azimuth phi (from +x towards +y, 0 to 2 pi)
 * and polar angle theta (from +z, 0 to pi). With u = phi / 2 pi and v = theta /
 * pi, from 0 to 1, it meets the image at (u width, v height) in texels: row 0
 * begins at theta = 0, column 0 at phi = 0.
 *
 *            +z
 *             |  theta
 *             | /                 0 --> u      width
 *             |/                  +------------------+ 0
 *             +------ +y          | texel            |   |
 *            / \  |               |                  |   v
 *          +x   phi               +------------------+ height
 *
 * The direction of light is the way one looks to see it: `direction` always
 * points from the scene to the environment, is of length one and in the
 * world's frame. What it returns is good to 1e-4 of its value, or of the
 * texels around, besides what the rounding of the direction does. Any thread
 * may call at any time; only environment_table_make prepares anything. */
#ifndef RAYBOOK_LIGHTS_ENVIRONMENT_H
#define RAYBOOK_LIGHTS_ENVIRONMENT_H

#include "base/rgb.h"
#include "base/transform.h"
#include "image/image.h"

/* What sampling wants to have prepared. Its members are the module's own affair
 * and defined in environment.c; nobody else looks into it. */
struct environment_table;

struct environment {
    const struct image *image; /* at least 1 x 1; values finite, >= 0 */
    float scale;               /* factor of all radiance, finite, >= 0 */
    struct transform to_world; /* local to world directions: a rotation, or
                                  the mirror image of one */
    struct environment_table *table; /* from environment_table_make(image) */
};

/* The radiance from a direction: the image's value times scale. Bilinear
 * between texel centres, which lie at half integers (the first at u width = v
 * height = 1/2). Round the sphere it wraps: the last column's neighbour is the
 * first. Beyond the centres of the first and the last row, towards the poles,
 * that row's own blend goes on. */
rgb environment_radiance(const struct environment *e, vec3 direction);

/* Called once for a map, before any direction is picked. What it returns is
 * handed back as e->table, and in the end to environment_table_free; it may be
 * NULL if nothing needs preparing. The image stays as it is, and is there, for
 * as long. Memory: mem_alloc of base/memory.h. sampling/distribution.h has
 * tables that pick by weight, which may help. */
struct environment_table *environment_table_make(const struct image *image);

/* Releases the table and all that it owns; NULL is fine. */
void environment_table_free(struct environment_table *table);

/* Picks a direction. random: two numbers in [0, 1), the only source of chance:
 * the same numbers give the same direction. Returns its density per steradian,
 * which is what environment_pdf says of it (on a step of the density the value
 * of either side); finite and above 0. Only for a map that is black all over
 * it may be 0, and then *direction is not used. */
float environment_sample(const struct environment *e, vec2 random,
                         vec3 *direction);

/* The density with which environment_sample picks a direction, per steradian.
 * How it is distributed is up to you, as long as
 *
 * - it is above zero wherever the radiance is, also where a bright texel only
 *   shines into its neighbours by the bilinear blend: light that is never
 *   picked is lost;
 * - it is a density over the sphere, not over u and v: a row of the image near
 *   a pole is as wide as any other, but covers few directions;
 * - it integrates to one over the sphere, whatever scale is (of a black map it
 *   may be 0 everywhere, too);
 * - it is finite, also at a pole.
 *
 * A good one follows the luminance, so that bright parts are picked often. How
 * good is measured by the mean of
 *
 *     (luminance / density)^2  over picked directions,
 *
 * divided by the square of the mean of luminance / density. It is 1 when the
 * two are proportional: the lights that an estimate then needs are the fewest.
 * At 100 it takes a hundred times as many for the same noise. */
float environment_pdf(const struct environment *e, vec3 direction);

#endif
