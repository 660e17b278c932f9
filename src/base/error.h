/* error.h - what went wrong with the user's input, in one message.
 *
 * A function that can fail because of its input takes a struct error and
 * returns false after it has filled it. Internal inconsistencies are not
 * errors: they stop the program (assert). */
#ifndef RAYBOOK_BASE_ERROR_H
#define RAYBOOK_BASE_ERROR_H

#include <stdbool.h>

enum { ERROR_TEXT_SIZE = 1024 };

/* text is empty while nothing has failed; the first fault wins. */
struct error {
    char text[ERROR_TEXT_SIZE];
};

/* Store a printf-style message unless one is there already; returns false so
 * that a caller can write "return error_set(err, ...)". */
bool error_set(struct error *err, const char *format, ...);

#endif
