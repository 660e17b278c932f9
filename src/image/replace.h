/* replace.h - output files that are complete or absent.
 *
 * A file is written under a temporary name beside its place and renamed when
 * it is whole; a reader never sees half of it, and an interrupted run leaves
 * the old file. */
#ifndef RAYBOOK_IMAGE_REPLACE_H
#define RAYBOOK_IMAGE_REPLACE_H

#include <stdbool.h>

#include "base/error.h"

enum { REPLACE_PATH_SIZE = 4096 };

struct replacement {
    char path[REPLACE_PATH_SIZE];
    char temporary[REPLACE_PATH_SIZE];
};

/* Chooses the temporary name and creates the empty file, so that a folder
 * that is missing or not writable is told before the work. End with one of
 * the other two before the next begins; if the program exits before that, the
 * temporary file is removed. */
bool replace_begin(struct replacement *r, const char *path, struct error *err);

/* Puts the temporary file in its place. */
bool replace_commit(struct replacement *r, struct error *err);

/* Removes the temporary file. */
void replace_abandon(struct replacement *r);

#endif
