/* camera.h - rays from the eye through the film: a pinhole. */
#ifndef RAYBOOK_CAMERA_CAMERA_H
#define RAYBOOK_CAMERA_CAMERA_H

#include "base/ray.h"
#include "base/ray_differential.h"
#include "scene/settings.h"

/* right and down span the film plane at distance one from the eye: from the
 * film's centre, right reaches its right edge and down its lower edge. */
struct camera {
    vec3 eye, forward, right, down;
    int width, height; /* pixels */
};

struct camera camera_make(const struct camera_settings *settings,
                          const struct film_settings *film);

/* The ray through a place on the film, in pixels from its upper left corner:
 * (x, y) = (0.5, 0.5) is the middle of the first pixel. The direction has
 * length one; the range is [0, infinity]. */
ray camera_ray(const struct camera *c, vec2 place);

/* How that ray changes to the next pixel on the right and the one below. */
struct ray_differential camera_differential(const struct camera *c, vec2 place);

#endif
