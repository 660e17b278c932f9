/* environment_map.h - environment lights made, measured and released. */
#ifndef RAYBOOK_LIGHTS_ENVIRONMENT_MAP_H
#define RAYBOOK_LIGHTS_ENVIRONMENT_MAP_H

#include "lights/environment.h"

/* The environment owns its table: release it with environment_free. image and
 * its values must outlive it. */
struct environment environment_make(const struct image *image, float scale,
                                    struct transform to_world);

/* Mean luminance over the sphere, W m^-2 sr^-1. */
float environment_mean_luminance(const struct environment *e);

/* An environment that is all zero is fine. */
void environment_free(struct environment *e);

#endif
