/* json_place.h - telling where in a JSON text something is wrong. */
#ifndef RAYBOOK_SCENE_JSON_PLACE_H
#define RAYBOOK_SCENE_JSON_PLACE_H

#include <cjson/cJSON.h>
#include <stdbool.h>

#include "base/error.h"

enum { JSON_PLACE_SIZE = 256 };

/* The JSON pointer (RFC 6901) of a node: "/objects/3/material_name", empty for
 * the root. Searched for from the root when a message needs it, so that
 * reading need not keep track of where it is. */
void json_pointer(const cJSON *root, const cJSON *node,
                  char out[JSON_PLACE_SIZE]);

/* What a node is, in words: the string "abc", the number 3, a list of 2. */
void json_describe(const cJSON *node, char out[JSON_PLACE_SIZE]);

/* Stores "file:line:column: message", the line and a caret under the place
 * where the parser stopped; returns false. */
bool json_syntax_fault(const char *file, const char *text, const char *stopped,
                       struct error *err);

#endif
