/* json_reader.c - see json_reader.h. */
#include "scene/json_reader.h"

#include <float.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "base/nearest.h"
#include "scene/json_place.h"
#include "scene/text_file.h"

const struct json_range any_float = {-FLT_MAX, FLT_MAX, "a number"};
const struct json_range above_zero = {FLT_MIN, FLT_MAX, "a number above 0"};
const struct json_range zero_or_more = {0.0, FLT_MAX, "a number, 0 or more"};

void json_set_up(void)
{
    cJSON_Hooks hooks = {mem_alloc_bytes, mem_free};
    cJSON_InitHooks(&hooks);
}

bool json_open_text(struct json_reader *j, const char *name, const char *text,
                    struct error *err)
{
    const char *stopped = NULL;
    j->file = name;
    j->err = err;
    j->root = cJSON_ParseWithOpts(text, &stopped, 1);
    if (j->root != NULL)
        return true;
    return json_syntax_fault(name, text, stopped, err);
}

bool json_open(struct json_reader *j, const char *path, struct error *err)
{
    j->root = NULL;
    char *text = text_file_read(path, err);
    if (text == NULL)
        return false;
    bool fine = json_open_text(j, path, text, err);
    mem_free(text);
    return fine;
}

void json_close(struct json_reader *j)
{
    cJSON_Delete(j->root);
    j->root = NULL;
}

bool json_fine(const struct json_reader *j)
{
    return j->err->text[0] == '\0';
}

bool json_fault(struct json_reader *j, const cJSON *node, const char *format,
                ...)
{
    char where[JSON_PLACE_SIZE], message[ERROR_TEXT_SIZE / 2];
    va_list args;
    va_start(args, format);
    vsnprintf(message, sizeof message, format, args);
    va_end(args);
    json_pointer(j->root, node, where);
    return error_set(j->err, "%s: %s: %s", j->file,
                     where[0] != '\0' ? where : "the whole file", message);
}

bool json_unexpected(struct json_reader *j, const cJSON *node,
                     const char *expected)
{
    char found[JSON_PLACE_SIZE];
    json_describe(node, found);
    return json_fault(j, node, "found %s, expected %s", found, expected);
}

const cJSON *json_get(const cJSON *object, const char *key)
{
    return cJSON_GetObjectItemCaseSensitive(object, key);
}

const cJSON *json_require(struct json_reader *j, const cJSON *object,
                          const char *key)
{
    const cJSON *node = json_get(object, key);
    if (node == NULL)
        json_fault(j, object, "the key \"%s\" is missing", key);
    return node;
}

static bool listed(const char *text, const char *const names[])
{
    for (int i = 0; names[i] != NULL; i++)
        if (strcmp(text, names[i]) == 0)
            return true;
    return false;
}

/* "a, b, c" cut where it does not fit. */
static void join(const char *const names[], char *out, size_t size)
{
    size_t used = 0;
    out[0] = '\0';
    for (int i = 0; names[i] != NULL && used < size; i++)
        used += (size_t)snprintf(out + used, size - used, "%s\"%s\"",
                                 i > 0 ? ", " : "", names[i]);
}

static bool unknown(struct json_reader *j, const cJSON *node, const char *what,
                    const char *text, const char *const names[])
{
    char all[ERROR_TEXT_SIZE / 4];
    const char *near = nearest_name(text, names);
    if (near != NULL)
        return json_fault(j, node, "unknown %s \"%.64s\": did you mean \"%s\"?",
                          what, text, near);
    join(names, all, sizeof all);
    return json_fault(j, node, "unknown %s \"%.64s\", expected one of %s", what,
                      text, all);
}

static bool twice(const cJSON *object, const cJSON *member)
{
    for (const cJSON *other = object->child; other != member;
         other = other->next)
        if (strcmp(other->string, member->string) == 0)
            return true;
    return false;
}

bool json_keys(struct json_reader *j, const cJSON *node,
               const char *const known[])
{
    if (!cJSON_IsObject(node))
        return json_unexpected(j, node, "an object { ... }");
    for (const cJSON *m = node->child; m != NULL; m = m->next) {
        if (!listed(m->string, known))
            return unknown(j, node, "key", m->string, known);
        if (twice(node, m))
            return json_fault(j, node, "the key \"%s\" is there twice",
                              m->string);
    }
    return true;
}

bool json_is_list(struct json_reader *j, const cJSON *node)
{
    return cJSON_IsArray(node) || json_unexpected(j, node, "a list [ ... ]");
}

bool json_is_table(struct json_reader *j, const cJSON *node)
{
    if (!cJSON_IsObject(node))
        return json_unexpected(j, node, "an object of named entries");
    for (const cJSON *m = node->child; m != NULL; m = m->next)
        if (twice(node, m))
            return json_fault(j, m, "the name \"%s\" is there twice",
                              m->string);
    return true;
}

int json_name(struct json_reader *j, const cJSON *node,
              const char *const names[])
{
    if (node == NULL)
        return 0;
    const char *text = json_string(j, node, "");
    for (int i = 0; names[i] != NULL && json_fine(j); i++)
        if (strcmp(text, names[i]) == 0)
            return i;
    unknown(j, node, "name", text, names);
    return 0;
}

double json_number(struct json_reader *j, const cJSON *node,
                   struct json_range range, double otherwise)
{
    if (node == NULL)
        return otherwise;
    double value = node->valuedouble;
    if (cJSON_IsNumber(node) && value >= range.least && value <= range.most)
        return value;
    json_unexpected(j, node, range.expected);
    return otherwise;
}

float json_float(struct json_reader *j, const cJSON *node,
                 struct json_range range, float otherwise)
{
    return (float)json_number(j, node, range, otherwise);
}

int json_integer(struct json_reader *j, const cJSON *node,
                 struct json_range range, int otherwise)
{
    double value = json_number(j, node, range, otherwise);
    if (value == (double)(int)value)
        return (int)value;
    json_unexpected(j, node, range.expected);
    return otherwise;
}

bool json_bool(struct json_reader *j, const cJSON *node, bool otherwise)
{
    if (node != NULL && !cJSON_IsBool(node))
        json_unexpected(j, node, "true or false");
    return cJSON_IsBool(node) ? cJSON_IsTrue(node) : otherwise;
}

const char *json_string(struct json_reader *j, const cJSON *node,
                        const char *otherwise)
{
    if (node != NULL && !cJSON_IsString(node))
        json_unexpected(j, node, "a string");
    return cJSON_IsString(node) ? node->valuestring : otherwise;
}

/* count numbers into out; out is left alone when the key is absent. */
static bool read_numbers(struct json_reader *j, const cJSON *node, int count,
                         const char *expected, struct json_range range,
                         float out[])
{
    if (node == NULL)
        return false;
    if (!cJSON_IsArray(node) || cJSON_GetArraySize(node) != count)
        return json_unexpected(j, node, expected);
    int i = 0;
    for (const cJSON *item = node->child; item != NULL; item = item->next)
        out[i++] = json_float(j, item, range, 0.0f);
    return json_fine(j);
}

vec2 json_vec2(struct json_reader *j, const cJSON *node, vec2 otherwise)
{
    float v[2];
    if (!read_numbers(j, node, 2, "a list of 2 numbers", any_float, v))
        return otherwise;
    return vec2_make(v[0], v[1]);
}

vec3 json_vec3(struct json_reader *j, const cJSON *node, vec3 otherwise)
{
    float v[3];
    if (!read_numbers(j, node, 3, "a list of 3 numbers", any_float, v))
        return otherwise;
    return vec3_make(v[0], v[1], v[2]);
}

rgb json_rgb(struct json_reader *j, const cJSON *node, rgb otherwise)
{
    float v[3];
    if (!read_numbers(j, node, 3, "a list of 3 numbers", zero_or_more, v))
        return otherwise;
    return rgb_make(v[0], v[1], v[2]);
}

struct transform json_transform(struct json_reader *j, const cJSON *node)
{
    float rows[16];
    struct transform t = transform_identity();
    if (!read_numbers(j, node, 16, "a list of 16 numbers, row by row",
                      any_float, rows))
        return t;
    if (!transform_from_rows(rows, &t)) {
        json_fault(j, node,
                   "the transform cannot be inverted or its last row is not "
                   "0, 0, 0, 1");
        return transform_identity();
    }
    return t;
}
