/* text_file.h - reading a whole file that holds text. */
#ifndef RAYBOOK_SCENE_TEXT_FILE_H
#define RAYBOOK_SCENE_TEXT_FILE_H

#include "base/error.h"

/* The file's bytes and a final '\0'; the caller owns them. NULL, with *err
 * filled, when it is missing, not a regular file, not readable, larger than
 * 4 GiB, or holds a byte 0 (which text does not). */
char *text_file_read(const char *path, struct error *err);

#endif
