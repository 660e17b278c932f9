/* rect_light.h - assignment 08: light from an area.
 *
 *            rect->normal
 *                 ^
 *        _________|________         Only the side that the normal points to
 *       /   on_light      /         shines, with the same radiance in all
 *      /_______*_________/          directions.
 *               \
 *                \  distance
 *                 \
 *                  * point          (the normal is drawn upwards, the point
 *                                    below: it sees no light here)
 *
 * To light a point, the framework picks a place on the rectangle and divides
 * the light that comes from there by the density of the direction to it.
 *
 * For all three: nothing is allocated, nothing is kept between calls, any
 * thread may call at any time. Lengths are in metres, from 1e-6 to 1e6, areas
 * from 1e-12 to 1e12 and above 0. Where the angle between a direction and the
 * surface is below 1e-6 radians, rounding decides on which side it is, and the
 * answer of either side will do. Results are good to 1e-4 of their value,
 * besides what the rounding of a grazing angle's cosine does to them. */
#ifndef RAYBOOK_LIGHTS_RECT_LIGHT_H
#define RAYBOOK_LIGHTS_RECT_LIGHT_H

#include "base/rgb.h"
#include "base/vec.h"
#include "shapes/rect.h"

/* A place on the rectangle: in its plane and within its edges, but for rounding
 * (1e-6 of its size and its distance from the origin).
 *
 * random: two numbers in [0, 1), the only source of chance: the same numbers
 * give the same place. Numbers spread evenly over the unit square must give
 * places spread evenly over the area; which number moves the place in which
 * way is up to you.
 *
 * rect->center is the middle, rect->side_x and rect->side_y are whole sides,
 * from edge to edge; they need neither be at right angles nor of length one. */
vec3 rect_light_place(const struct rect *rect, vec2 random);

/* A place is picked evenly over an area: its density is 1 / area, per square
 * metre. Seen from `point`, that is a density of directions, per steradian; it
 * is what this function returns. Directions to far or tilted places lie
 * closer together.
 *
 * area: the whole of it, in m^2. normal: of the surface at on_light, of length
 * one. Finite and above 0 where the point is in front of the surface. 0 where
 * it is not: behind it, in its plane, or at on_light itself.
 *
 * Lights made of triangles use the function, too. */
float area_light_pdf(vec3 point, vec3 on_light, vec3 normal, float area);

/* The radiance that leaves a surface in a direction: `radiance`, as it is, on
 * the side of the normal (of length one), black on the other and along the
 * surface. outgoing: away from the surface, of any length from 1e-6 to 1e6;
 * its length changes nothing. */
rgb area_light_emitted(rgb radiance, vec3 normal, vec3 outgoing);

#endif
