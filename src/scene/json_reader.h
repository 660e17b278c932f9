/* json_reader.h - reading checked values out of a JSON document.
 *
 * Every function that finds something wrong stores one message in
 * reader.err ("scene.json: /film/resolution: found ..., expected ...") and
 * returns a harmless value, so that a caller reads on and asks once, at the
 * end, whether all was well. The first fault is the one that is told.
 *
 * Objects are maps whose keys must be known: call json_keys on each. */
#ifndef RAYBOOK_SCENE_JSON_READER_H
#define RAYBOOK_SCENE_JSON_READER_H

#include <cjson/cJSON.h>
#include <stdbool.h>

#include "base/error.h"
#include "base/rgb.h"
#include "base/transform.h"
#include "base/vec.h"

struct json_reader {
    const char *file; /* as messages name it */
    cJSON *root;      /* owned: json_close */
    struct error *err;
};

/* Numbers in [least, most]; expected is how a message puts it. */
struct json_range {
    double least, most;
    const char *expected;
};

/* Makes cJSON allocate where everything else does (base/memory.h); once, before
 * the first use of it. */
void json_set_up(void);

/* Reads a whole file; false when it can't be read or is not JSON (the message
 * then names line and column and shows the place). */
bool json_open(struct json_reader *j, const char *path, struct error *err);

/* Parses text that has no file, such as an option's value; name stands for it
 * in messages. */
bool json_open_text(struct json_reader *j, const char *name, const char *text,
                    struct error *err);

void json_close(struct json_reader *j);

/* Has nothing gone wrong so far? */
bool json_fine(const struct json_reader *j);

/* Stores "file: /pointer/to/node: message" and returns false. */
bool json_fault(struct json_reader *j, const cJSON *node, const char *format,
                ...);

/* A fault that names what the node is and what was expected instead. */
bool json_unexpected(struct json_reader *j, const cJSON *node,
                     const char *expected);

/* The member of an object, or NULL; keys are case-sensitive. */
const cJSON *json_get(const cJSON *object, const char *key);

/* The member, which must be there. */
const cJSON *json_require(struct json_reader *j, const cJSON *object,
                          const char *key);

/* Checks that node is an object, has no key twice and none that is not in the
 * NULL-terminated list. */
bool json_keys(struct json_reader *j, const cJSON *node,
               const char *const known[]);

bool json_is_list(struct json_reader *j, const cJSON *node);

/* Is node an object of named entries, no name there twice? */
bool json_is_table(struct json_reader *j, const cJSON *node);

/* Which of the NULL-terminated names the string is; 0 after a fault. */
int json_name(struct json_reader *j, const cJSON *node,
              const char *const names[]);

/* The values below: node NULL (the key is absent) gives `otherwise`. */
double json_number(struct json_reader *j, const cJSON *node,
                   struct json_range range, double otherwise);
float json_float(struct json_reader *j, const cJSON *node,
                 struct json_range range, float otherwise);
int json_integer(struct json_reader *j, const cJSON *node,
                 struct json_range range, int otherwise);
bool json_bool(struct json_reader *j, const cJSON *node, bool otherwise);
const char *json_string(struct json_reader *j, const cJSON *node,
                        const char *otherwise);
vec2 json_vec2(struct json_reader *j, const cJSON *node, vec2 otherwise);
vec3 json_vec3(struct json_reader *j, const cJSON *node, vec3 otherwise);
struct transform json_transform(struct json_reader *j, const cJSON *node);

/* Three numbers, none below zero. */
rgb json_rgb(struct json_reader *j, const cJSON *node, rgb otherwise);

extern const struct json_range any_float, above_zero, zero_or_more;

#endif
