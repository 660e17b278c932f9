/* statistics.h - what a rendering cost, as JSON. */
#ifndef RAYBOOK_PROGRAM_STATISTICS_H
#define RAYBOOK_PROGRAM_STATISTICS_H

#include <stdbool.h>

#include "base/counters.h"
#include "base/error.h"
#include "scene/scene.h"

struct statistics {
    const struct scene *scene;
    struct counters counters;
    const char *accel;
    int threads;
    double load_seconds, build_seconds, render_seconds;
};

/* Writes to a file, which is then complete or absent, or for "-" to standard
 * output. */
bool statistics_write(const struct statistics *s, const char *path,
                      struct error *err);

#endif
