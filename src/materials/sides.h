/* sides.h - is a direction above or below a surface?
 *
 * A smooth mesh has two answers: that of the true triangle and that of the
 * normal that is interpolated between its corners. Near the rim they differ. */
#ifndef RAYBOOK_MATERIALS_SIDES_H
#define RAYBOOK_MATERIALS_SIDES_H

#include "shapes/surface.h"

/* 1: direction points to the outside by both normals. -1: to the inside by
 * both. 0: the two disagree, or it lies in the surface. */
static inline int surface_side(const struct surface *s, vec3 direction)
{
    float geometric = vec3_dot(direction, s->geometric_normal);
    float smooth = vec3_dot(direction, s->shading_normal);
    return (geometric > 0.0f && smooth > 0.0f) -
           (geometric < 0.0f && smooth < 0.0f);
}

#endif
