/* options.h - the command line. */
#ifndef RAYBOOK_PROGRAM_OPTIONS_H
#define RAYBOOK_PROGRAM_OPTIONS_H

#include <stdbool.h>
#include <stdint.h>

#include "accel/accel.h"
#include "base/error.h"
#include "integrators/render.h"

/* Groups of extra channels, as bits; NULL-terminated names in this order. */
enum aov {
    AOV_BIT_ALBEDO = 1,
    AOV_BIT_NORMAL = 2,
    AOV_BIT_DEPTH = 4,
    AOV_BIT_UV = 8,
    AOV_BIT_BVH_COST = 16,
    AOV_BIT_MIP_LEVEL = 32,
    AOV_BIT_VARIANCE = 64
};
extern const char *const aov_names[];

/* What the user asked for. Strings belong to argv. "given" numbers replace
 * the scene's own; 0 (or -1 for the seed) leaves them. */
struct options {
    const char *scene;
    const char *output; /* NULL: the scene's name + .exr */
    const char *png;
    const char *stats; /* "-": standard output */
    const char *override;
    int integrator; /* enum integrator_kind; < 0: the scene's own */
    enum accel_kind accel;
    int spp, max_depth, threads;
    int64_t seed;
    int width, height;
    double time_limit; /* seconds; 0: none */
    bool has_crop;
    struct window crop;
    unsigned aovs; /* bits of enum aov */
    bool has_pixel;
    int pixel_x, pixel_y;
    bool preview;
    const char *tev; /* HOST:PORT of a viewer, or NULL */
    bool quiet, help, version;
};

/* Reads argv into *out; false, with *err filled, for anything that is not
 * understood. */
bool options_parse(int argc, char *argv[], struct options *out,
                   struct error *err);

void options_print_help(void);

#endif
