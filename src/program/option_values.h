/* option_values.h - reading the values of options.
 *
 * Each function returns false (or -1) and fills *err, naming option and value,
 * when the text is not what was expected. */
#ifndef RAYBOOK_PROGRAM_OPTION_VALUES_H
#define RAYBOOK_PROGRAM_OPTION_VALUES_H

#include <stdbool.h>

#include "base/error.h"

/* "--spp x: expected ... (try --help)"; returns false. */
bool option_wrong(const char *name, const char *value, const char *expected,
                  struct error *err);

/* A whole number from least to most. */
bool option_read_whole(const char *name, const char *text, long long least,
                       long long most, long long *out, struct error *err);

/* A whole number from 1 to most. */
bool option_read_int(const char *name, const char *text, int most, int *out,
                     struct error *err);

/* count whole numbers from 0 to FILM_MAX_SIDE with one separator between them
 * and nothing after. Fills no error. */
bool option_read_list(const char *text, char separator, int count, int out[]);

/* The index in a NULL-terminated list of names. */
int option_read_name(const char *name, const char *value,
                     const char *const names[], struct error *err);

/* Does a file name end so, with something before? */
bool option_has_ending(const char *path, const char *ending);

#endif
