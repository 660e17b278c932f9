/* load.h - from a scene file to a struct scene. */
#ifndef RAYBOOK_SCENE_LOAD_H
#define RAYBOOK_SCENE_LOAD_H

#include <stdbool.h>

#include "base/error.h"
#include "scene/scene.h"

/* Reads a scene file and all that it refers to into *out, which the caller
 * releases with scene_free whatever the answer.
 *
 * override (NULL: none) is JSON text merged into the scene before it is read:
 * objects member by member, everything else replaced, null removes (RFC 7396).
 *
 * Returns false on the first fault, told in *err with file and place. */
bool scene_load(const char *path, const char *override, struct scene *out,
                struct error *err);

#endif
