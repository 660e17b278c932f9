/* options.h - the command line. */
#ifndef RAYBOOK_PROGRAM_OPTIONS_H
#define RAYBOOK_PROGRAM_OPTIONS_H

#include <stdbool.h>
#include <stdint.h>

#include "accel/accel.h"
#include "base/error.h"
#include "integrators/render.h"

/* What the user asked for. Strings belong to argv. "given" numbers replace
 * the scene's own; 0 (or -1 for the seed) leaves them. */
struct options {
    const char *scene;
    const char *output; /* NULL: the scene's name + .exr */
    const char *png;
    const char *stats; /* "-": standard output */
    const char *override;
    const char *integrator;
    enum accel_kind accel;
    int spp, max_depth, threads;
    int64_t seed;
    int width, height;
    double time_limit; /* seconds; 0: none */
    bool has_crop;
    struct window crop;
    bool quiet, help, version;
};

/* Reads argv into *out; false, with *err filled, for anything that is not
 * understood. */
bool options_parse(int argc, char *argv[], struct options *out,
                   struct error *err);

void options_print_help(void);

#endif
