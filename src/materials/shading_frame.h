/* shading_frame.h - the axes in which a material is described.
 *
 * z is the shading normal; x runs along u, the texture's first coordinate, so
 * that brushed metal is brushed along the texture. */
#ifndef RAYBOOK_MATERIALS_SHADING_FRAME_H
#define RAYBOOK_MATERIALS_SHADING_FRAME_H

#include "shapes/surface.h"

/* Right-handed and orthonormal. */
struct shading_frame {
    vec3 x, y, z;
};

/* x is dp_du less its part along the shading normal (Gram and Schmidt). Where
 * that leaves next to nothing, as at the poles of a sphere, it is some
 * direction at right angles to the normal. */
struct shading_frame shading_frame_make(const struct surface *s);

/* A direction of the world in the frame's coordinates, and back. */
vec3 shading_frame_to_local(const struct shading_frame *f, vec3 world);
vec3 shading_frame_to_world(const struct shading_frame *f, vec3 local);

#endif
