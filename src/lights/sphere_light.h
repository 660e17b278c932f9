/* sphere_light.h - light from a ball: only its visible cap is worth asking.
 *
 * Seen from outside, a sphere fills a cone of directions. They are picked
 * evenly: P. Shirley, C. Wang, K. Zimmerman, "Monte Carlo Techniques for
 * Direct Lighting Calculations", ACM Transactions on Graphics 15(1), 1996. */
#ifndef RAYBOOK_LIGHTS_SPHERE_LIGHT_H
#define RAYBOOK_LIGHTS_SPHERE_LIGHT_H

#include <stdbool.h>

#include "shapes/sphere.h"

/* Picks a direction (unit) from the point to the sphere and the place on it
 * that is seen there first; *normal is the outward one. random: two numbers in
 * [0, 1). false: the point is inside. */
bool sphere_light_sample(const struct sphere *s, vec3 point, vec2 random,
                         vec3 *direction, vec3 *place, vec3 *normal);

/* The density, per steradian, of every direction from the point to the sphere;
 * 0 inside. */
float sphere_light_pdf(const struct sphere *s, vec3 point);

#endif
