/* read_hdr.c - see read_hdr.h. */
#include "image/read_hdr.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "base/memory.h"
#include "image/read_limits.h"

/* ---- the header ---- */

enum { LINE_SIZE = 256 };

/* The next line without its end; what is beyond the buffer is dropped. false
 * at the end of the file. */
static bool read_line(FILE *file, char line[LINE_SIZE])
{
    size_t length = 0;
    int byte = fgetc(file);
    for (; byte != EOF && byte != '\n'; byte = fgetc(file))
        if (length < LINE_SIZE - 1)
            line[length++] = (char)byte;
    line[length] = '\0';
    return byte != EOF;
}

/* Up to the empty line; does it say that pixels are RGBE? */
static bool read_variables(FILE *file)
{
    char line[LINE_SIZE];
    bool rgbe = false;
    while (read_line(file, line) && line[0] != '\0')
        rgbe = rgbe || strcmp(line, "FORMAT=32-bit_rle_rgbe") == 0;
    return rgbe;
}

static bool read_size(FILE *file, int *width, int *height)
{
    char line[LINE_SIZE];
    int used = -1;
    if (!read_line(file, line))
        return false;
    sscanf(line, "-Y %9d +X %9d%n", height, width, &used);
    return used >= 0 && line[used] == '\0';
}

/* ---- rows of width x 4 bytes: red, green, blue and exponent ---- */

/* One of the four bytes of all the pixels of a row: a count above 128 repeats
 * the next byte count - 128 times, another gives that many bytes. */
static bool read_runs(FILE *file, uint8_t *first, int width)
{
    int x = 0;
    while (x < width) {
        int count = fgetc(file);
        bool run = count > 128;
        int length = run ? count - 128 : count;
        if (length < 1 || length > width - x)
            return false;
        int byte = 0;
        for (int i = 0; i < length; i++) {
            byte = run && i > 0 ? byte : fgetc(file);
            if (byte == EOF)
                return false;
            first[4 * x++] = (uint8_t)byte;
        }
    }
    return true;
}

static bool read_encoded_row(FILE *file, uint8_t *row, int width)
{
    for (int i = 0; i < 4; i++)
        if (!read_runs(file, row + i, width))
            return false;
    return true;
}

/* A pixel of which no mantissa is above 1 is an instruction of an older way of
 * run-length encoding, which nobody has written since 1991. */
static bool has_old_runs(const uint8_t *row, int width)
{
    for (int x = 0; x < width; x++)
        if (row[4 * x] == 1 && row[4 * x + 1] == 1 && row[4 * x + 2] == 1)
            return true;
    return false;
}

/* A row that is encoded begins with 2, 2 and its width in two bytes. */
static bool read_row(FILE *file, uint8_t *row, int width)
{
    size_t rest = 4 * ((size_t)width - 1);
    if (fread(row, 1, 4, file) != 4)
        return false;
    if (width >= 8 && row[0] == 2 && row[1] == 2 && row[2] < 128)
        return 256 * row[2] + row[3] == width &&
               read_encoded_row(file, row, width);
    return fread(row + 4, 1, rest, file) == rest && !has_old_runs(row, width);
}

static rgb color_of(const uint8_t rgbe[4])
{
    float unit = rgbe[3] > 0 ? ldexpf(1.0f, rgbe[3] - (128 + 8)) : 0.0f;
    return rgb_make((float)rgbe[0] * unit, (float)rgbe[1] * unit,
                    (float)rgbe[2] * unit);
}

/* The number of rows that could be read. */
static int read_rows(FILE *file, struct image *image)
{
    int y = 0;
    uint8_t *row = mem_alloc((size_t)image->width, 4);
    for (; y < image->height && read_row(file, row, image->width); y++)
        for (int x = 0; x < image->width; x++)
            image->pixels[(size_t)y * (size_t)image->width + (size_t)x] =
                color_of(&row[4 * x]);
    mem_free(row);
    return y;
}

bool hdr_read(FILE *file, const char *path, struct image *out,
              struct error *err)
{
    int width, height;
    if (!read_variables(file))
        return error_set(err,
                         "%s: the HDR file's header has no line "
                         "\"FORMAT=32-bit_rle_rgbe\"",
                         path);
    if (!read_size(file, &width, &height))
        return error_set(err,
                         "%s: the HDR file's size is not given as "
                         "\"-Y height +X width\"",
                         path);
    if (!image_size_is_fine(path, "the HDR file", width, height, err))
        return false;
    *out = image_make(width, height);
    int rows = read_rows(file, out);
    if (rows == height)
        return true;
    image_free(out);
    return error_set(err, "%s: the HDR file %s row %d of %d", path,
                     feof(file) ? "ends in" : "is damaged in", rows + 1,
                     height);
}
