/* json_place.c - see json_place.h. */
#include "scene/json_place.h"

#include <stdio.h>
#include <string.h>

/* Appends one step, with ~ and / escaped as the RFC asks. */
static size_t append_step(char out[JSON_PLACE_SIZE], size_t used,
                          const cJSON *member, int index)
{
    if (member->string == NULL)
        return used + (size_t)snprintf(out + used, JSON_PLACE_SIZE - used,
                                       "/%d", index);
    if (used + 1 < JSON_PLACE_SIZE)
        out[used++] = '/';
    for (const char *c = member->string; *c != '\0'; c++) {
        const char *escaped = *c == '~' ? "~0" : *c == '/' ? "~1" : NULL;
        if (used + 3 >= JSON_PLACE_SIZE)
            break;
        if (escaped != NULL)
            out[used++] = escaped[0];
        out[used++] = escaped != NULL ? escaped[1] : *c;
    }
    out[used] = '\0';
    return used;
}

static bool find(const cJSON *at, const cJSON *node, char out[JSON_PLACE_SIZE],
                 size_t used)
{
    if (at == node)
        return true;
    int index = 0;
    for (const cJSON *m = at->child; m != NULL; m = m->next, index++) {
        size_t longer = append_step(out, used, m, index);
        if (longer < JSON_PLACE_SIZE && find(m, node, out, longer))
            return true;
        out[used] = '\0';
    }
    return false;
}

void json_pointer(const cJSON *root, const cJSON *node,
                  char out[JSON_PLACE_SIZE])
{
    out[0] = '\0';
    if (root != NULL && node != NULL && !find(root, node, out, 0))
        out[0] = '\0';
}

void json_describe(const cJSON *node, char out[JSON_PLACE_SIZE])
{
    if (node == NULL)
        snprintf(out, JSON_PLACE_SIZE, "nothing");
    else if (cJSON_IsString(node))
        snprintf(out, JSON_PLACE_SIZE, "the string \"%.64s\"",
                 node->valuestring);
    else if (cJSON_IsNumber(node))
        snprintf(out, JSON_PLACE_SIZE, "the number %.9g", node->valuedouble);
    else if (cJSON_IsBool(node))
        snprintf(out, JSON_PLACE_SIZE, "%s",
                 cJSON_IsTrue(node) ? "true" : "false");
    else if (cJSON_IsArray(node))
        snprintf(out, JSON_PLACE_SIZE, "a list of %d",
                 cJSON_GetArraySize(node));
    else
        snprintf(out, JSON_PLACE_SIZE, "%s",
                 cJSON_IsObject(node) ? "an object" : "null");
}

static bool visible(char c)
{
    return (unsigned char)c >= 0x20 && (unsigned char)c < 0x7f;
}

/* The line around a place, at most 60 characters of it, unprintable ones as
 * '?', and a caret below the place. */
static void show_line(const char *line, size_t column, char *out, size_t size)
{
    char shown[61];
    size_t from = column > 40 ? column - 40 : 0, length = 0;
    for (const char *c = line + from;
         *c != '\0' && *c != '\n' && *c != '\r' && length < 60; c++)
        shown[length++] = visible(*c) ? *c : '?';
    shown[length] = '\0';
    snprintf(out, size, "  %s\n  %*s", shown, (int)(column - from) + 1, "^");
}

/* Where a key should begin (behind '{' or ','), cJSON stops one byte behind
 * whatever else is there: go back to it. Most of what may end a value well is
 * left alone, but a '}' behind a comma ends nothing. */
static const char *true_place(const char *text, const char *stopped)
{
    const char *blank = " \t\r\n", *fine = "\"{}[]-0123456789,:";
    if (stopped - text < 2 || strchr(blank, stopped[-1]))
        return stopped;
    const char *before = stopped - 2;
    while (before > text && strchr(blank, *before))
        before--;
    if (stopped[-1] == '}'
            ? *before == ','
            : !strchr(fine, stopped[-1]) && (*before == '{' || *before == ','))
        return stopped - 1;
    return stopped;
}

/* What the parser met, for people. */
static void describe_stop(const char *stopped, char *out, size_t size)
{
    if (*stopped == '\0')
        snprintf(out, size, "the text ends too early");
    else if (!visible(*stopped))
        snprintf(out, size, "unexpected byte 0x%02x", (unsigned char)*stopped);
    else
        snprintf(out, size, "not valid JSON from '%c' on", *stopped);
}

bool json_syntax_fault(const char *file, const char *text, const char *stopped,
                       struct error *err)
{
    const char *line = text;
    int number = 1;
    char shown[160], what[64];
    if (stopped == NULL)
        stopped = text;
    while (stopped > text && *stopped == '\0' && stopped[-1] == '\n')
        stopped--; /* an early end is told at the last line */
    stopped = true_place(text, stopped);
    for (const char *c = text; c < stopped; c++) {
        if (*c == '\n') {
            line = c + 1;
            number++;
        }
    }
    size_t column = (size_t)(stopped - line);
    describe_stop(*stopped == '\n' && stopped[1] == '\0' ? "" : stopped, what,
                  sizeof what);
    show_line(line, column, shown, sizeof shown);
    return error_set(err, "%s:%d:%zu: %s\n%s", file, number, column + 1, what,
                     shown);
}
