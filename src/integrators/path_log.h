/* path_log.h - telling a pixel's paths: what --pixel prints.
 *
 * Every function does nothing when log is NULL, so that the integrators call
 * them without asking. */
#ifndef RAYBOOK_INTEGRATORS_PATH_LOG_H
#define RAYBOOK_INTEGRATORS_PATH_LOG_H

#include <stdio.h>

#include "scene/scene.h"

/* Where to print, and how deep the path is. */
struct path_log {
    FILE *out;
    int depth;
};

void path_log_camera(struct path_log *log, uint32_t sample, vec2 place,
                     const ray *r);
void path_log_hit(struct path_log *log, const struct scene *scene,
                  const struct object *object, const struct surface *s,
                  float t);
void path_log_miss(struct path_log *log);
void path_log_light(struct path_log *log, const struct scene *scene,
                    const struct light *light, const struct light_sample *s,
                    rgb bsdf, rgb found);
void path_log_scatter(struct path_log *log, const struct scatter *way);
void path_log_found(struct path_log *log, rgb radiance, float share,
                    rgb throughput);
void path_log_result(struct path_log *log, rgb radiance);

#endif
