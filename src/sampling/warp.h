/* warp.h - the unit square bent into other shapes.
 *
 * Each function takes two numbers in [0, 1) to a point of a domain, with the
 * density that stands below it. Neighbours stay neighbours, so evenly spread
 * numbers make evenly spread points. Directions are in a frame with the pole
 * at +z; vec3_frame makes one for any axis. */
#ifndef RAYBOOK_SAMPLING_WARP_H
#define RAYBOOK_SAMPLING_WARP_H

#include "base/vec.h"

/* The largest float below 1. */
#define ONE_MINUS_EPSILON 0x1.fffffep-1f

/* Uniform over the disk of radius 1: squares around the centre become circles.
 * P. Shirley and K. Chiu, "A Low Distortion Map Between Disk and Square",
 * Journal of Graphics Tools 2(3), 1997. */
vec2 warp_disk(vec2 random);
float warp_disk_pdf(vec2 point); /* per unit of area */

/* Uniform over all directions. */
vec3 warp_sphere(vec2 random);
float warp_sphere_pdf(vec3 direction); /* per steradian, as all below */

/* Uniform over the directions with z >= 0. */
vec3 warp_hemisphere(vec2 random);
float warp_hemisphere_pdf(vec3 direction);

/* Over the directions with z >= 0, in proportion to z, the cosine: a uniform
 * disk lifted onto the hemisphere (Malley's method). */
vec3 warp_cosine_hemisphere(vec2 random);
float warp_cosine_hemisphere_pdf(vec3 direction);

/* Uniform over the directions within an angle of +z. The angle is given as 1 -
 * its cosine, in (0, 2], because a narrow cone's cosine is 1 in float. On the
 * rim, within rounding, the density may be either value. */
vec3 warp_cone(vec2 random, float one_minus_cosine);
float warp_cone_pdf(vec3 direction, float one_minus_cosine);

/* Uniform over a triangle: the barycentric weights of its second and third
 * corner. E. Heitz, "A Low-Distortion Map Between Triangle and Square", 2019.
 */
vec2 warp_triangle(vec2 random);
float warp_triangle_pdf(vec2 weights); /* per unit of area of the weights */

/* Over the unit square, in proportion to the bilinear blend of the values, all
 * >= 0, at its corners (0,0), (1,0), (0,1), (1,1); uniform if all are 0. */
vec2 warp_bilinear(vec2 random, const float corners[4]);
float warp_bilinear_pdf(vec2 point, const float corners[4]);

#endif
