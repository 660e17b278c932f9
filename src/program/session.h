/* session.h - one run of the program: from a scene file to a full film. */
#ifndef RAYBOOK_PROGRAM_SESSION_H
#define RAYBOOK_PROGRAM_SESSION_H

#include <stdbool.h>

#include "base/error.h"
#include "camera/film.h"
#include "integrators/render.h"
#include "program/options.h"
#include "program/preview.h"
#include "program/progress.h"
#include "program/statistics.h"
#include "program/tev.h"
#include "scene/scene.h"

/* All zero but for the options before session_load; session_free releases
 * everything whatever has happened. */
struct session {
    struct options options;
    struct scene scene;
    struct film film;
    struct window window; /* what is rendered */
    struct progress_bar bar;
    struct preview preview;
    struct tev viewer;
    struct statistics statistics;
    double deadline;  /* of progress_clock; 0: none */
    bool interrupted; /* by Ctrl-C: not all samples were taken */
};

/* Reads the scene and builds its acceleration structure; false: bad input. */
bool session_load(struct session *s, struct error *err);

/* Takes the samples, until done, or Ctrl-C, or the time limit. */
void session_render(struct session *s);

void session_free(struct session *s);

#endif
