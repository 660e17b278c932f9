/* results.h - the files that a run leaves. */
#ifndef RAYBOOK_PROGRAM_RESULTS_H
#define RAYBOOK_PROGRAM_RESULTS_H

#include <stdbool.h>

#include "base/error.h"
#include "program/session.h"

/* Where a run's results go. */
struct results {
    char *output;  /* the image */
    char *command; /* the command line, for the image's header */
};

/* From the options; release with results_free. */
struct results results_make(const struct options *o, int argc, char *argv[]);

/* Can all of them be written? Told before the work, not after it. */
bool results_possible(const struct results *r, const struct options *o,
                      struct error *err);

/* Writes image, preview and statistics, and says so on standard error. */
bool results_write(const struct results *r, const struct session *s,
                   struct error *err);

void results_free(struct results *r);

#endif
