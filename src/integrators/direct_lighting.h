/* direct_lighting.h - assignment 05: what one light makes of a point. */
#ifndef RAYBOOK_INTEGRATORS_DIRECT_LIGHTING_H
#define RAYBOOK_INTEGRATORS_DIRECT_LIGHTING_H

#include "integrators/tracer.h"

/* The radiance (W m^-2 sr^-1) that the vertex v sends towards v->outgoing
 * because of the light that reaches it from s->direction:
 *
 *     material_eval(outgoing, s->direction) x s->radiance x |cosine| / s->pdf
 *
 * to about one part in 10^4, with the cosine between s->direction and the
 * shading normal, both of length one. All these directions point away from
 * the surface. v->object->material, which is not NULL, says by itself where a
 * surface is black: on its back, say, or where the light is behind it.
 *
 * Black where anything blocks the light. The way that must be free goes from
 * the vertex to s->target, or in s->direction for ever where s->infinite
 * (then s->target means nothing). Every object blocks, glass too. The surface
 * itself never does, nor does what lies beyond the target, nor the surface
 * that the target lies on: a lamp may lie on a table. What stands between
 * blocks however near to either end it is, down to 10^-5 of the way's length,
 * or of the largest coordinate where that is larger; closer than that either
 * answer is right. No other length is special: a scene may be a millimetre wide
 * or a kilometre. scene_segment_blocked and scene_direction_blocked see to all
 * of that.
 *
 * s comes from light_sample, which never gives a pdf of 0. For a light without
 * extent (s->delta) pdf is 1 and `radiance` is the irradiance on a surface that
 * faces the light: the formula is the same.
 *
 * Not asked: other lights, light that comes by detours, ambient light, what the
 * vertex emits. Changes nothing but the counters of the scene's queries; may
 * be called from many threads at once. */
rgb direct_light(const struct scene *scene, const struct vertex *v,
                 const struct light_sample *s);

#endif
