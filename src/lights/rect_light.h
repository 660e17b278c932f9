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
 * the light that comes from there by the density of the direction to it. */
#ifndef RAYBOOK_LIGHTS_RECT_LIGHT_H
#define RAYBOOK_LIGHTS_RECT_LIGHT_H

#include "base/rgb.h"
#include "base/vec.h"
#include "shapes/rect.h"

/* A place on the rectangle. random: two numbers in [0, 1); numbers spread
 * evenly over the unit square must give places spread evenly over the area.
 * The sides need neither be at right angles nor of length one. */
vec3 rect_light_place(const struct rect *rect, vec2 random);

/* A place is picked evenly over an area: its density is 1 / area, per square
 * metre. Seen from `point`, that is a density of directions, per steradian; it
 * is what this function returns. Directions to far or tilted places lie
 * closer together.
 *
 * area: the whole of it, in m^2. normal: of the surface at on_light, of length
 * one. 0 where the point is not in front of the surface (behind it, in its
 * plane, or at on_light itself).
 *
 * Lights made of triangles use the function, too. */
float area_light_pdf(vec3 point, vec3 on_light, vec3 normal, float area);

/* The radiance that leaves a surface in a direction (of any length, away from
 * the surface): `radiance` on the side of the normal, black on the other and
 * along the surface. */
rgb area_light_emitted(rgb radiance, vec3 normal, vec3 outgoing);

#endif
