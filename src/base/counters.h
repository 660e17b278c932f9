/* counters.h - how much work was done, counted in every build.
 *
 * Each thread counts in its own struct; nothing is shared while rendering.
 * The framework counts (not the modules that students write), so that the
 * figures are comparable between two solutions. */
#ifndef RAYBOOK_BASE_COUNTERS_H
#define RAYBOOK_BASE_COUNTERS_H

#include <stdint.h>

struct counters {
    uint64_t camera_rays;    /* rays that start at the camera */
    uint64_t specular_rays;  /* continued through glass or by a mirror */
    uint64_t bounce_rays;    /* continued by chance from a rough surface */
    uint64_t shadow_rays;    /* any-hit queries towards a light */
    uint64_t boxes_tested;   /* ray-box tests; eight a node of the wide tree */
    uint64_t leaves_visited; /* leaf ranges handed to the primitive test */
    uint64_t primitives_tested; /* eight a leaf of the wide tree */
    uint64_t samples;           /* image samples finished */
};

/* The calling thread's own counters, zero when the thread starts.
 *
 * gcc's and clang's word, since C99 has none. OpenMP's threadprivate would do,
 * but clang looks for an initializer at each use, and objects of which some
 * are gcc's then cannot always be linked. */
extern __thread struct counters counters_mine;

/* Adds the calling thread's counters to *total and zeroes them. The caller
 * sees to it that one thread at a time does so. */
void counters_flush(struct counters *total);

#endif
