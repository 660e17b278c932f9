/* nearest.h - "did you mean ...?" */
#ifndef RAYBOOK_BASE_NEAREST_H
#define RAYBOOK_BASE_NEAREST_H

/* The name of a NULL-terminated list that a typing mistake away (about a third
 * of its letters) gives text, or NULL when none is that near. Letters only
 * differing in case count as equal. */
const char *nearest_name(const char *text, const char *const names[]);

#endif
