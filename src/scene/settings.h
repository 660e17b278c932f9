/* settings.h - what a scene file says beside its geometry. */
#ifndef RAYBOOK_SCENE_SETTINGS_H
#define RAYBOOK_SCENE_SETTINGS_H

#include <stdint.h>

#include "base/vec.h"
#include "sampling/sampler.h"

/* Largest film: a pixel takes about 50 bytes while it is rendered. */
enum { FILM_MAX_SIDE = 65536, FILM_MAX_PIXELS = 1 << 26 };
enum { SPP_MAX = 1 << 24, DEPTH_MAX = 1 << 16 };

/* Lists of names are NULL-terminated and in the order of their enum. */
enum filter_kind { FILTER_BOX, FILTER_TENT, FILTER_GAUSSIAN, FILTER_MITCHELL };
extern const char *const filter_names[];

struct film_settings {
    int width, height;
    enum filter_kind filter;
    float filter_radius; /* in pixels */
    float alpha, b, c;   /* gaussian; mitchell */
};

struct camera_settings {
    vec3 position, look_at, up;
    float vertical_fov; /* degrees, in (0, 180) */
};

enum integrator_kind {
    INTEGRATOR_INTERSECTION_TEST,
    INTEGRATOR_DIRECT,
    INTEGRATOR_PATH,
    INTEGRATOR_NORMAL,
    INTEGRATOR_DEPTH,
    INTEGRATOR_UV,
    INTEGRATOR_BVH_COST,
    INTEGRATOR_MIP_LEVEL
};
extern const char *const integrator_names[];

/* path: how light is found. RW: by chance alone, NEE: by asking the lights at
 * each vertex, MIS: by both, weighted. */
enum path_profile { PROFILE_RW, PROFILE_NEE, PROFILE_MIS };

/* Which lights a vertex asks: each of them, or one, picked evenly or by its
 * power. */
enum light_selection { SELECT_ALL, SELECT_UNIFORM, SELECT_POWER };
extern const char *const light_selection_names[];

struct integrator_settings {
    enum integrator_kind kind;
    int spp, max_depth;
    enum path_profile profile;
    float rr_threshold; /* Russian roulette below this throughput */
    enum light_selection selection;
    enum sampler_kind sampler;
    uint64_t seed;
};

#endif
