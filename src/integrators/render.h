/* render.h - the loop over pixels and samples. */
#ifndef RAYBOOK_INTEGRATORS_RENDER_H
#define RAYBOOK_INTEGRATORS_RENDER_H

#include <stdbool.h>
#include <stdint.h>

#include "base/counters.h"
#include "camera/film.h"
#include "integrators/path_log.h"
#include "scene/scene.h"

/* From (x0, y0) up to but without (x1, y1), in pixels of the whole film. */
struct window {
    int x0, y0, x1, y1;
};

struct render_options {
    struct window window;
    int threads; /* 0: as many as there are processors */

    /* Where to tell the paths of the window's pixels (then with one thread);
     * NULL: nowhere. */
    struct path_log *log;

    /* Asked before each tile, from any one thread at a time: true ends the
     * rendering early. */
    bool (*stop)(void *user, uint64_t samples_done);

    /* Called after each pass, while no thread works on the film; NULL: not. */
    void (*pass_done)(void *user, const struct film *film);

    /* true: a stop waits until every pixel has the same number of samples. */
    bool whole_passes;
    void *user;
};

/* Adds the scene's samples to the film (of the scene's resolution, empty; its
 * extra channels too if it has them) and the work done to *total.
 *
 * A pixel's value depends on scene, seed, pixel and sample index only: the
 * same bits for any number of threads, any window and any order. The samples
 * of a pixel are taken in passes, few at first, so that a picture that is cut
 * short is a noisy one and not a part of one. Returns false when stopped. */
bool render(const struct scene *scene, const struct render_options *options,
            struct film *film, struct counters *total);

#endif
