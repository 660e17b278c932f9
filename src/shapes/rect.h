/* rect.h - a flat parallelogram: walls, panes, lamps. */
#ifndef RAYBOOK_SHAPES_RECT_H
#define RAYBOOK_SHAPES_RECT_H

#include <stdbool.h>

#include "base/box.h"
#include "base/ray.h"
#include "base/transform.h"
#include "shapes/surface.h"

/* The image of the unit square -1/2 <= x, y <= 1/2 in the plane z = 0 under a
 * transform. The normal is the image of +z: normalized, by the inverse
 * transpose. */
struct rect {
    vec3 center;
    vec3 side_x, side_y; /* images of the x and y axis, whole lengths */
    vec3 normal;
    float area;
};

struct rect rect_make(const struct transform *to_world);

/* The t in [t_min, t_max] at which the ray meets the rectangle, edges
 * included, from either side. On a miss returns false and leaves *t alone. */
bool rect_intersect(const struct rect *s, const ray *r, float *t);

/* The surface at a hit. u runs along +x from 0 to 1, v along -y: v = 0 is the
 * edge at y = +1/2, so that an image stands upright. */
void rect_surface(const struct rect *s, const ray *r, float t,
                  struct surface *out);

aabb rect_bounds(const struct rect *s);

#endif
