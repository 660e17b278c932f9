/* jpeg_check.c - see jpeg_check.h. */
#include "image/jpeg_check.h"

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "image/read_limits.h"

/* T.81, table B.1: the second byte of a marker, after 0xff. */
enum {
    MARKER_SOF0 = 0xc0, /* baseline frame */
    MARKER_SOF2 = 0xc2, /* progressive frame */
    MARKER_DHT = 0xc4,
    MARKER_RST0 = 0xd0,
    MARKER_RST7 = 0xd7,
    MARKER_EOI = 0xd9,
    MARKER_SOS = 0xda
};

/* The largest table in use has 162 codes. stb_image keeps code 255 for its own
 * purposes. libjpeg's tools, too, stop at 500 scans. */
enum { MOST_CODES = 255, MOST_SCANS = 500, MOST_COMPONENTS = 4 };

enum { SEGMENT_SIZE = 65536 };

struct jpeg {
    FILE *file;
    uint8_t segment[SEGMENT_SIZE]; /* without its length */
    size_t size;
    bool progressive;
    int width, height;
    int component_count; /* 0: no frame so far */
    uint8_t components[MOST_COMPONENTS];
    bool scanned[MOST_COMPONENTS];
    bool has_table[2][16]; /* [0]: DC, [1]: AC */
    int scan_count;
};

/* The next marker, whatever lies before it; bytes 0xff 0x00 and restarts are
 * part of a scan's data. EOF at the end. */
static int next_marker(FILE *file)
{
    int before = 0, byte = fgetc(file);
    while (byte != EOF) {
        bool stuffed = byte == 0 || byte == 0xff;
        bool restart = byte >= MARKER_RST0 && byte <= MARKER_RST7;
        if (before == 0xff && !stuffed && !restart)
            return byte;
        before = byte;
        byte = fgetc(file);
    }
    return EOF;
}

static bool read_segment(struct jpeg *j)
{
    int high = fgetc(j->file), low = fgetc(j->file);
    if (high == EOF || low == EOF || 256 * high + low < 2)
        return false;
    j->size = (size_t)(256 * high + low - 2);
    return fread(j->segment, 1, j->size, j->file) == j->size;
}

/* Each table: class and number, how many codes of 1 .. 16 bits, the codes. */
static const char *check_tables(struct jpeg *j)
{
    size_t at = 0;
    while (at < j->size) {
        size_t codes = 0;
        if (j->size - at < 17)
            return "a Huffman table is cut off";
        uint8_t name = j->segment[at];
        for (int i = 1; i <= 16; i++)
            codes += j->segment[at + (size_t)i];
        if (name >> 4 > 1 || codes > MOST_CODES)
            return "a Huffman table is not one";
        j->has_table[name >> 4][name & 15] = true;
        at += 17 + codes;
    }
    return at == j->size ? NULL : "a Huffman table is cut off";
}

/* Precision, height, width, then three bytes a component; the first is its
 * name. */
static const char *check_frame(struct jpeg *j)
{
    size_t count = j->size >= 6 ? j->segment[5] : 0;
    if (j->component_count > 0)
        return "there are two frames";
    if (count < 1 || count > MOST_COMPONENTS || j->size != 6 + 3 * count)
        return "the frame's header is not one";
    for (size_t i = 0; i < count; i++)
        j->components[i] = j->segment[6 + 3 * i];
    j->component_count = (int)count;
    j->height = 256 * j->segment[1] + j->segment[2];
    j->width = 256 * j->segment[3] + j->segment[4];
    return NULL;
}

/* Does the file have the tables that a component of a scan is decoded by?
 * tables: the DC table's number times 16, plus the AC table's. */
static bool has_tables(const struct jpeg *j, uint8_t tables, uint8_t first)
{
    bool dc = j->has_table[0][tables >> 4];
    bool ac = j->has_table[1][tables & 15];
    if (j->progressive)
        return first == 0 ? dc : ac;
    return dc && ac;
}

static bool note_scanned(struct jpeg *j, uint8_t name)
{
    bool found = false;
    for (int i = 0; i < j->component_count; i++)
        if (j->components[i] == name)
            found = j->scanned[i] = true;
    return found;
}

/* Count, two bytes a component, then the first coefficient and two more. */
static const char *check_scan(struct jpeg *j)
{
    size_t count = j->size >= 1 ? j->segment[0] : 0;
    if (count < 1 || count > MOST_COMPONENTS || j->size != 4 + 2 * count)
        return "a scan's header is not one";
    if (++j->scan_count > MOST_SCANS)
        return "there are more than 500 scans";
    uint8_t first = j->segment[1 + 2 * count];
    for (size_t i = 0; i < count; i++) {
        const uint8_t *component = &j->segment[1 + 2 * i];
        if (!note_scanned(j, component[0]))
            return "a scan is of a component that the frame does not have";
        if (!has_tables(j, component[1], first))
            return "a scan's Huffman table is missing";
    }
    return NULL;
}

static const char *check_end(const struct jpeg *j)
{
    for (int i = 0; i < j->component_count; i++)
        if (!j->scanned[i])
            return "a component has no scan";
    return j->component_count > 0 ? NULL : "there is no frame";
}

/* The first fault of the file, or NULL. */
static const char *find_fault(struct jpeg *j)
{
    const char *fault = NULL;
    int marker = 0;
    while (fault == NULL && marker != MARKER_EOI) {
        marker = next_marker(j->file);
        if (marker == MARKER_EOI)
            fault = check_end(j);
        else if (marker == EOF || !read_segment(j))
            fault = "the file ends before the picture";
        else if (marker == MARKER_DHT)
            fault = check_tables(j);
        else if (marker == MARKER_SOS)
            fault = check_scan(j);
        else if (marker >= MARKER_SOF0 && marker <= MARKER_SOF2)
            fault = check_frame(j);
        j->progressive = j->progressive || marker == MARKER_SOF2;
    }
    return fault;
}

bool jpeg_check(FILE *file, const char *path, struct error *err)
{
    struct jpeg j;
    memset(&j, 0, sizeof j);
    j.file = file;
    fseek(file, 2, SEEK_SET); /* after the start-of-image marker */
    const char *fault = find_fault(&j);
    if (fault == NULL)
        return image_size_is_fine(path, "the JPEG file", j.width, j.height,
                                  err);
    return error_set(err, "%s: the JPEG file is damaged or truncated: %s", path,
                     fault);
}
