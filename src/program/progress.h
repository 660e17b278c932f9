/* progress.h - a line that says how far the rendering is. */
#ifndef RAYBOOK_PROGRAM_PROGRESS_H
#define RAYBOOK_PROGRAM_PROGRESS_H

#include <stdbool.h>
#include <stdint.h>

struct progress_bar {
    bool shown;            /* only on a terminal */
    double started, drawn; /* seconds */
    uint64_t total;        /* samples */
};

/* Columns of the terminal at standard error; 80 where that can't be told. */
int progress_terminal_width(void);

/* Seconds of a clock that only goes forward. */
double progress_clock(void);

struct progress_bar progress_start(uint64_t total_samples, bool quiet);

/* Draws anew, at most some times a second. */
void progress_update(struct progress_bar *bar, uint64_t samples_done);

/* Removes the line. */
void progress_end(struct progress_bar *bar);

#endif
