/* text_file.c - see text_file.h. */
#define _POSIX_C_SOURCE 200809L

#include "scene/text_file.h"

#include <errno.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "base/memory.h"

static const uint64_t largest = UINT64_C(1) << 32;

/* The size, or -1 with *err filled. */
static int64_t regular_size(const char *path, struct error *err)
{
    struct stat info;
    if (stat(path, &info) != 0) {
        error_set(err, "%.300s: cannot read: %s", path, strerror(errno));
        return -1;
    }
    if (!S_ISREG(info.st_mode)) {
        error_set(err, "%s: cannot read: %s, expected a file", path,
                  S_ISDIR(info.st_mode) ? "it is a folder" : "not a file");
        return -1;
    }
    if ((uint64_t)info.st_size > largest) {
        error_set(err, "%s: %lld bytes are too many, at most 4 GiB", path,
                  (long long)info.st_size);
        return -1;
    }
    return info.st_size;
}

/* Tells the place of a byte 0 as an editor shows it. */
static void fault_of_zero(const char *path, const char *text, const char *zero,
                          struct error *err)
{
    int line = 1;
    const char *line_start = text;
    for (const char *c = text; c < zero; c++) {
        if (*c == '\n') {
            line_start = c + 1;
            line++;
        }
    }
    error_set(err, "%s:%d:%td: found a byte of value 0, expected text (UTF-8)",
              path, line, zero - line_start + 1);
}

char *text_file_read(const char *path, struct error *err)
{
    int64_t size = regular_size(path, err);
    if (size < 0)
        return NULL;
    FILE *file = fopen(path, "rb");
    if (file == NULL) {
        error_set(err, "%.300s: cannot read: %s", path, strerror(errno));
        return NULL;
    }
    char *text = mem_alloc((size_t)size + 1, 1);
    size_t got = fread(text, 1, (size_t)size, file);
    fclose(file);
    const char *zero = memchr(text, '\0', got);
    if (got == (size_t)size && zero == NULL)
        return text;
    if (zero != NULL)
        fault_of_zero(path, text, zero, err);
    else
        error_set(err, "%s: cannot read all of it", path);
    mem_free(text);
    return NULL;
}
