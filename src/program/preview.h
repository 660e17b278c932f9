/* preview.h - the picture in the terminal, while it renders. */
#ifndef RAYBOOK_PROGRAM_PREVIEW_H
#define RAYBOOK_PROGRAM_PREVIEW_H

#include <stdbool.h>

#include "camera/film.h"
#include "integrators/render.h"

struct preview {
    bool shown;
    int rows; /* lines that the last picture took */
};

/* Shows the film's window on standard error, over the picture before: each
 * character is two pixels, one above the other (U+2580 with a colour of its
 * own and one for the background), tone-mapped as a PNG is. Does nothing
 * where standard error is not a terminal. */
void preview_show(struct preview *p, const struct film *film,
                  const struct window *window);

#endif
