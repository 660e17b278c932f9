/* mirror.h - the angle out is the angle in. */
#ifndef RAYBOOK_MATERIALS_MIRROR_H
#define RAYBOOK_MATERIALS_MIRROR_H

#include "base/vec.h"

/* The mirror image of outgoing about the axis normal; both of length one and
 * pointing away from the surface. Which way normal points does not matter. */
static inline vec3 mirror_direction(vec3 normal, vec3 outgoing)
{
    float twice = 2.0f * vec3_dot(normal, outgoing);
    return vec3_sub(vec3_scale(normal, twice), outgoing);
}

#endif
