/*
 * decode_exr.c - pictures that a stranger may have written, as plain numbers.
 *
 *     decode_exr PICTURES RESULTS MOST_PIXELS MOST_SAMPLES
 *
 * Runs in a box, and nothing here is believed outside of it. It decodes; what
 * a picture may be is said in judge/exr_rules.py. All numbers are in the
 * machine's byte order, floats and int32 but for the lengths.
 *
 * PICTURES holds for each picture a uint64 length and as many bytes: an EXR
 * file of one part with scan lines. RESULTS gets for each, in order:
 *   1. a status (see `enum status`), a length and as many bytes of what the
 *      library said, if it said anything;
 *   2. from HEADER on: data window, display window (each x0 y0 x1 y1), the
 *      number of channels, and for each its samplings in x and y, a length
 *      and a name;
 *   3. for PIXELS: R, G, B of all pixels of the data window, row by row.
 */
#include <OpenEXR/openexr.h>
#include <inttypes.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image/half.h"

enum status {
    NO_HEADER,   /* the header is damaged */
    HEADER,      /* too large, or not what has R, G and B: not decoded */
    COMPRESSION, /* DWAA or DWAB, which OpenEXRCore 3.1 cannot read */
    NO_PIXELS,   /* the header is fine, the pixels are damaged */
    PIXELS
};

/* A hostile header can make a chunk, which is some rows, huge. */
static const uint64_t most_chunk_bytes = UINT64_C(1) << 30;

struct limits {
    int64_t pixels, samples; /* samples: pixels times channels */
};

struct picture {
    const uint8_t *bytes;
    uint64_t size;
    char said[200];
    exr_context_t context;
    exr_attr_box2i_t data, display;
    const exr_attr_chlist_t *channels;
    float *rgb; /* of the data window */
};

/* ---- the library's view of bytes in memory ---- */

static int64_t size_of(exr_const_context_t context, void *user)
{
    (void)context;
    return (int64_t)((const struct picture *)user)->size;
}

static int64_t read_at(exr_const_context_t context, void *user, void *buffer,
                       uint64_t size, uint64_t offset,
                       exr_stream_error_func_ptr_t error)
{
    const struct picture *p = user;
    (void)context, (void)error;
    if (offset >= p->size)
        return 0;
    const uint64_t left = p->size - offset;
    const uint64_t count = size < left ? size : left;
    memcpy(buffer, p->bytes + offset, count);
    return (int64_t)count;
}

/* The first complaint is the one that explains the others. */
static void note(exr_const_context_t context, exr_result_t code,
                 const char *message)
{
    void *user = NULL;
    (void)code;
    if (exr_get_user_data(context, &user) != EXR_ERR_SUCCESS || user == NULL)
        return;
    struct picture *p = user;
    if (p->said[0] == '\0')
        snprintf(p->said, sizeof p->said, "%s", message);
}

/* What a damaged chunk leaves unwritten is 0, and not what was there. */
static void *zeros(size_t size)
{
    return calloc(1, size);
}

/* ---- the header ---- */

static exr_result_t open_picture(struct picture *p)
{
    exr_context_initializer_t options = EXR_DEFAULT_CONTEXT_INITIALIZER;
    options.error_handler_fn = note;
    options.alloc_fn = zeros;
    options.free_fn = free;
    options.user_data = p;
    options.read_fn = read_at;
    options.size_fn = size_of;
    options.flags = EXR_CONTEXT_FLAG_DISABLE_CHUNK_RECONSTRUCTION;
    return exr_start_read(&p->context, "picture", &options);
}

static bool read_header(struct picture *p)
{
    int parts;
    exr_storage_t storage;
    return exr_get_count(p->context, &parts) == EXR_ERR_SUCCESS && parts == 1 &&
           exr_get_storage(p->context, 0, &storage) == EXR_ERR_SUCCESS &&
           storage == EXR_STORAGE_SCANLINE &&
           exr_get_data_window(p->context, 0, &p->data) == EXR_ERR_SUCCESS &&
           exr_get_display_window(p->context, 0, &p->display) ==
               EXR_ERR_SUCCESS &&
           exr_get_channels(p->context, 0, &p->channels) == EXR_ERR_SUCCESS;
}

static int64_t width_of(const struct picture *p)
{
    return (int64_t)p->data.max.x - p->data.min.x + 1;
}

static int64_t height_of(const struct picture *p)
{
    return (int64_t)p->data.max.y - p->data.min.y + 1;
}

/* 0 for R, 1 for G, 2 for B, -1 for a channel that nobody wants. */
static int component_of(const char *name)
{
    static const char *const names[3] = {"R", "G", "B"};
    for (int i = 0; i < 3; i++)
        if (strcmp(name, names[i]) == 0)
            return i;
    return -1;
}

static bool channels_are_plain(const struct picture *p)
{
    unsigned found = 0;
    for (int i = 0; i < p->channels->num_channels; i++) {
        const exr_attr_chlist_entry_t *channel = &p->channels->entries[i];
        const int component = component_of(channel->name.str);
        if (channel->x_sampling != 1 || channel->y_sampling != 1)
            return false;
        found |= component < 0 ? 0U : 1U << component;
    }
    return found == 7U;
}

static bool is_small(const struct picture *p, const struct limits *most)
{
    uint64_t chunk;
    const int64_t w = width_of(p), h = height_of(p);
    return w >= 1 && h >= 1 && w <= most->pixels && h <= most->pixels / w &&
           p->channels->num_channels <= most->samples / (w * h) &&
           exr_get_chunk_unpacked_size(p->context, 0, &chunk) ==
               EXR_ERR_SUCCESS &&
           chunk <= most_chunk_bytes;
}

static bool is_dwa(const struct picture *p)
{
    exr_compression_t compression;
    return exr_get_compression(p->context, 0, &compression) ==
               EXR_ERR_SUCCESS &&
           (compression == EXR_COMPRESSION_DWAA ||
            compression == EXR_COMPRESSION_DWAB);
}

/* ---- the pixels ---- */

/* A number as it stands in an unpacked chunk. */
static float value_at(const uint8_t *bytes, uint16_t type)
{
    uint16_t half;
    uint32_t whole;
    float value;
    if (type == EXR_PIXEL_HALF) {
        memcpy(&half, bytes, sizeof half);
        return half_to_float(half);
    }
    memcpy(&whole, bytes, sizeof whole);
    memcpy(&value, bytes, sizeof value);
    return type == EXR_PIXEL_FLOAT ? value : (float)whole;
}

static void unpack_row(float *row, const exr_coding_channel_info_t *channel,
                       const uint8_t *bytes)
{
    const int component = component_of(channel->channel_name);
    for (int x = 0; component >= 0 && x < channel->width; x++)
        row[3 * x + component] =
            value_at(bytes + (size_t)x * (size_t)channel->bytes_per_element,
                     channel->data_type);
}

/* Row by row, in each row channel by channel. */
static void unpack_chunk(const struct picture *p,
                         const exr_decode_pipeline_t *decoder, int64_t first)
{
    const uint8_t *bytes = decoder->unpacked_buffer;
    for (int y = 0; y < decoder->chunk.height; y++)
        for (int i = 0; i < decoder->channel_count; i++) {
            const exr_coding_channel_info_t *channel = &decoder->channels[i];
            unpack_row(p->rgb + 3 * (first + y) * width_of(p), channel, bytes);
            bytes +=
                (size_t)channel->width * (size_t)channel->bytes_per_element;
        }
}

/* Will the library fill what unpack_chunk reads, and will that fit? What is
 * not compressed it does not check. */
static bool chunk_is_whole(const struct picture *p,
                           const exr_decode_pipeline_t *decoder, int64_t first)
{
    const exr_chunk_info_t *chunk = &decoder->chunk;
    uint64_t row = 0;
    for (int i = 0; i < decoder->channel_count; i++) {
        const exr_coding_channel_info_t *channel = &decoder->channels[i];
        if (channel->width != width_of(p))
            return false;
        row += (uint64_t)channel->width * (uint64_t)channel->bytes_per_element;
    }
    return chunk->height > 0 && first + chunk->height <= height_of(p) &&
           row * (uint64_t)chunk->height == chunk->unpacked_size &&
           chunk->packed_size > 0 &&
           (chunk->compression != EXR_COMPRESSION_NONE ||
            chunk->packed_size == chunk->unpacked_size);
}

static exr_result_t leave_unpacked(exr_decode_pipeline_t *decoder)
{
    (void)decoder;
    return EXR_ERR_SUCCESS;
}

/* The library reads and decompresses; as in image/read_exr.c, its unpacking is
 * not used, and a chunk that stands in the file as it is is left so. */
static exr_result_t decode(const struct picture *p,
                           exr_decode_pipeline_t *decoder, int64_t first)
{
    if (!chunk_is_whole(p, decoder, first))
        return EXR_ERR_BAD_CHUNK_LEADER;
    exr_result_t result =
        exr_decoding_choose_default_routines(p->context, 0, decoder);
    decoder->unpack_and_convert_fn = leave_unpacked;
    if (decoder->chunk.packed_size == decoder->chunk.unpacked_size)
        decoder->decompress_fn = NULL;
    if (result == EXR_ERR_SUCCESS)
        result = exr_decoding_run(p->context, 0, decoder);
    return result;
}

/* The chunk whose first row is row `first` of the data window. */
static bool read_chunk(const struct picture *p, int64_t first)
{
    exr_chunk_info_t chunk;
    exr_decode_pipeline_t decoder = EXR_DECODE_PIPELINE_INITIALIZER;
    exr_result_t result = exr_read_scanline_chunk_info(
        p->context, 0, (int)(p->data.min.y + first), &chunk);
    if (result != EXR_ERR_SUCCESS)
        return false;
    result = exr_decoding_initialize(p->context, 0, &chunk, &decoder);
    if (result == EXR_ERR_SUCCESS)
        result = decode(p, &decoder, first);
    if (result == EXR_ERR_SUCCESS)
        unpack_chunk(p, &decoder, first);
    exr_decoding_destroy(p->context, &decoder);
    return result == EXR_ERR_SUCCESS;
}

static bool read_pixels(struct picture *p)
{
    int32_t rows;
    p->rgb = calloc((size_t)(width_of(p) * height_of(p)), 3 * sizeof *p->rgb);
    bool fine = p->rgb != NULL && exr_get_scanlines_per_chunk(
                                      p->context, 0, &rows) == EXR_ERR_SUCCESS;
    for (int64_t y = 0; fine && y < height_of(p); y += rows)
        fine = read_chunk(p, y);
    return fine;
}

static enum status examine(struct picture *p, const struct limits *most)
{
    if (open_picture(p) != EXR_ERR_SUCCESS || !read_header(p))
        return NO_HEADER;
    if (!channels_are_plain(p) || !is_small(p, most))
        return HEADER;
    if (is_dwa(p))
        return COMPRESSION;
    return read_pixels(p) ? PIXELS : NO_PIXELS;
}

/* ---- the results ---- */

static void write_number(FILE *out, int64_t number)
{
    const int32_t value = (int32_t)number;
    fwrite(&value, sizeof value, 1, out);
}

static void write_text(FILE *out, const char *text)
{
    write_number(out, (int64_t)strlen(text));
    fputs(text, out);
}

static void write_window(FILE *out, const exr_attr_box2i_t *window)
{
    write_number(out, window->min.x);
    write_number(out, window->min.y);
    write_number(out, window->max.x);
    write_number(out, window->max.y);
}

static void write_header(FILE *out, const struct picture *p)
{
    write_window(out, &p->data);
    write_window(out, &p->display);
    write_number(out, p->channels->num_channels);
    for (int i = 0; i < p->channels->num_channels; i++) {
        write_number(out, p->channels->entries[i].x_sampling);
        write_number(out, p->channels->entries[i].y_sampling);
        write_text(out, p->channels->entries[i].name.str);
    }
}

static void write_picture(FILE *out, const struct picture *p,
                          enum status status)
{
    write_number(out, status);
    write_text(out, p->said);
    if (status >= HEADER)
        write_header(out, p);
    if (status == PIXELS)
        fwrite(p->rgb, 3 * sizeof *p->rgb, (size_t)(width_of(p) * height_of(p)),
               out);
}

static void serve(const uint8_t *bytes, uint64_t size,
                  const struct limits *most, FILE *out)
{
    struct picture p;
    memset(&p, 0, sizeof p);
    p.bytes = bytes;
    p.size = size;
    write_picture(out, &p, examine(&p, most));
    free(p.rgb);
    if (p.context != NULL)
        exr_finish(&p.context);
}

static bool serve_all(FILE *in, FILE *out, const struct limits *most)
{
    uint64_t size;
    while (fread(&size, sizeof size, 1, in) == 1) {
        uint8_t *bytes = malloc(size > 0 ? size : 1);
        if (bytes == NULL || fread(bytes, 1, size, in) != size)
            return false; /* the process ends: nothing to free */
        serve(bytes, size, most, out);
        free(bytes);
    }
    return true;
}

int main(int argc, char **argv)
{
    if (argc != 5)
        return 2;
    const struct limits most = {strtoll(argv[3], NULL, 10),
                                strtoll(argv[4], NULL, 10)};
    FILE *in = fopen(argv[1], "rb"), *out = fopen(argv[2], "wb");
    if (in == NULL || out == NULL)
        return 2;
    const bool done = serve_all(in, out, &most);
    return fclose(out) == 0 && done ? 0 : 1;
}
