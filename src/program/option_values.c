/* option_values.c - see option_values.h. */
#include "program/option_values.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/nearest.h"
#include "scene/settings.h"

bool option_wrong(const char *name, const char *value, const char *expected,
                  struct error *err)
{
    return error_set(err, "%s %s: expected %s (try --help)", name, value,
                     expected);
}

bool option_read_whole(const char *name, const char *text, long long least,
                       long long most, long long *out, struct error *err)
{
    char expected[80], *end;
    errno = 0;
    *out = strtoll(text, &end, 10);
    if (errno == 0 && end != text && *end == '\0' && *out >= least &&
        *out <= most)
        return true;
    snprintf(expected, sizeof expected, "a whole number from %lld to %lld",
             least, most);
    return option_wrong(name, text, expected, err);
}

bool option_read_int(const char *name, const char *text, int most, int *out,
                     struct error *err)
{
    long long value;
    if (!option_read_whole(name, text, 1, most, &value, err))
        return false;
    *out = (int)value;
    return true;
}

bool option_has_ending(const char *path, const char *ending)
{
    size_t length = strlen(path), tail = strlen(ending);
    return length > tail && strcmp(path + length - tail, ending) == 0;
}

bool option_read_list(const char *text, char separator, int count, int out[])
{
    for (int i = 0; i < count; i++) {
        char *end;
        errno = 0;
        long value = strtol(text, &end, 10);
        if (errno != 0 || end == text || value < 0 || value > FILM_MAX_SIDE)
            return false;
        if (*end != (i + 1 < count ? separator : '\0'))
            return false;
        out[i] = (int)value;
        text = end + 1;
    }
    return true;
}

int option_read_name(const char *name, const char *value,
                     const char *const names[], struct error *err)
{
    for (int i = 0; names[i] != NULL; i++)
        if (strcmp(value, names[i]) == 0)
            return i;
    const char *near = nearest_name(value, names);
    error_set(err, "%s %s: unknown name%s%s%s", name, value,
              near ? ", did you mean " : " (try --help)", near ? near : "",
              near ? "?" : "");
    return -1;
}
