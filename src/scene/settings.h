/* settings.h - what a scene file says beside its geometry. */
#ifndef RAYBOOK_SCENE_SETTINGS_H
#define RAYBOOK_SCENE_SETTINGS_H

#include <stdint.h>

#include "base/vec.h"

/* Largest film: a pixel takes about 50 bytes while it is rendered. */
enum { FILM_MAX_SIDE = 65536, FILM_MAX_PIXELS = 1 << 26 };
enum { SPP_MAX = 1 << 24, DEPTH_MAX = 1 << 16 };

struct film_settings {
    int width, height;
    float filter_radius; /* of the box filter, in pixels */
};

struct camera_settings {
    vec3 position, look_at, up;
    float vertical_fov; /* degrees, in (0, 180) */
};

enum integrator_kind { INTEGRATOR_INTERSECTION_TEST };

/* NULL-terminated, in the order of enum integrator_kind. */
extern const char *const integrator_names[];

struct integrator_settings {
    enum integrator_kind kind;
    int spp, max_depth;
    uint64_t seed;
};

#endif
