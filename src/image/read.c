/* read.c - see read.h. */
#define _POSIX_C_SOURCE 200809L

#include "image/read.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "image/read_exr.h"
#include "image/read_hdr.h"
#include "image/read_stb.h"

const char *const image_encoding_names[] = {"auto", "linear", "srgb", NULL};

/* ---- which kind of file ---- */

enum kind { KIND_EXR, KIND_HDR, KIND_PNG, KIND_JPEG, KIND_UNKNOWN };

struct signature {
    enum kind kind;
    size_t size;
    const char *bytes;
};

static const struct signature signatures[] = {
    {KIND_EXR, 4, "\x76\x2f\x31\x01"}, {KIND_HDR, 11, "#?RADIANCE\n"},
    {KIND_HDR, 7, "#?RGBE\n"},         {KIND_PNG, 8, "\x89PNG\r\n\x1a\n"},
    {KIND_JPEG, 3, "\xff\xd8\xff"},
};

static enum kind kind_of(const char *start, size_t size)
{
    size_t count = sizeof signatures / sizeof signatures[0];
    for (size_t i = 0; i < count; i++)
        if (size >= signatures[i].size &&
            memcmp(start, signatures[i].bytes, signatures[i].size) == 0)
            return signatures[i].kind;
    return KIND_UNKNOWN;
}

/* ---- opening ---- */

static FILE *open_file(const char *path, struct error *err)
{
    struct stat info;
    FILE *file = NULL;
    if (stat(path, &info) != 0)
        error_set(err, "%s: cannot read: %s", path, strerror(errno));
    else if (!S_ISREG(info.st_mode))
        error_set(err, "%s: cannot read: %s, expected an image file", path,
                  S_ISDIR(info.st_mode) ? "it is a folder" : "not a file");
    else if ((file = fopen(path, "rb")) == NULL)
        error_set(err, "%s: cannot read: %s", path, strerror(errno));
    return file;
}

/* ---- values ---- */

static bool value_is_fine(float value)
{
    return value >= 0.0f && value <= 3.40282347e38f; /* not NaN */
}

static const char *faulty_component(rgb color, float *value)
{
    *value = !value_is_fine(color.r)   ? color.r
             : !value_is_fine(color.g) ? color.g
                                       : color.b;
    return !value_is_fine(color.r)   ? "red"
           : !value_is_fine(color.g) ? "green"
           : !value_is_fine(color.b) ? "blue"
                                     : NULL;
}

static bool check_values(const char *path, const struct image *image,
                         struct error *err)
{
    size_t count = (size_t)image->width * (size_t)image->height;
    for (size_t i = 0; i < count; i++) {
        float value;
        const char *name = faulty_component(image->pixels[i], &value);
        if (name != NULL)
            return error_set(err,
                             "%s: pixel (%zu, %zu): %s is %g, expected a "
                             "finite number of at least 0",
                             path, i % (size_t)image->width,
                             i / (size_t)image->width, name, (double)value);
    }
    return true;
}

/* ---- reading ---- */

static bool read_kind(FILE *file, const char *path, enum kind kind,
                      enum image_encoding encoding, struct image *out,
                      struct error *err)
{
    bool srgb = encoding != ENCODING_LINEAR;
    if ((kind == KIND_EXR || kind == KIND_HDR) && encoding == ENCODING_SRGB)
        return error_set(err,
                         "%s: the encoding is \"srgb\", but an %s file is "
                         "linear: expected \"auto\" or \"linear\"",
                         path, kind == KIND_EXR ? "EXR" : "HDR");
    switch (kind) {
    case KIND_EXR:
        return exr_read(path, out, err);
    case KIND_HDR:
        return hdr_read(file, path, out, err);
    case KIND_UNKNOWN:
        return error_set(err,
                         "%s: not an image that can be read, expected EXR, "
                         "HDR, PNG or JPEG",
                         path);
    default:
        return stb_read(file, path, kind == KIND_JPEG, srgb, out, err);
    }
}

bool image_read(const char *path, enum image_encoding encoding,
                struct image *out, struct error *err)
{
    struct image none = {0, 0, NULL};
    char start[16];
    *out = none;
    FILE *file = open_file(path, err);
    if (file == NULL)
        return false;
    enum kind kind = kind_of(start, fread(start, 1, sizeof start, file));
    rewind(file);
    bool fine = read_kind(file, path, kind, encoding, out, err) &&
                check_values(path, out, err);
    fclose(file);
    if (!fine) {
        image_free(out);
        *out = none;
    }
    return fine;
}
