/* read_exr.c - see read_exr.h.
 *
 * OpenEXRCore reads the header and unpacks chunks (some rows, or a tile); this
 * file decides what a picture may be, converts the numbers and puts them in
 * their place. */
#include "image/read_exr.h"

#include <OpenEXR/openexr.h>
#include <inttypes.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "base/memory.h"
#include "image/half.h"
#include "image/read_limits.h"

/* A chunk is rows or a tile with all channels, and a hostile header can make
 * it huge. Even 256 rows, the most that a compression has, of 8192 pixels with
 * a hundred channels are less. */
static const uint64_t most_chunk_bytes = UINT64_C(1) << 30;

/* The corners of a window, both inside. */
struct window {
    int64_t x0, y0, x1, y1;
};

struct exr_file {
    const char *path;
    struct error *err;
    exr_context_t context;
    struct window display, data;
    bool grey;           /* Y instead of R, G and B */
    struct image *image; /* the display window */
};

/* OpenEXRCore would print its own errors; ours go through struct error. */
static void silent(exr_const_context_t context, exr_result_t code,
                   const char *message)
{
    (void)context, (void)code, (void)message;
}

static bool refuse(struct exr_file *f, const char *what)
{
    return error_set(f->err, "%s: %s", f->path, what);
}

/* DWAA and DWAB compression came to OpenEXRCore after 3.1. */
static bool is_fine(struct exr_file *f, exr_result_t result, const char *what)
{
    if (result == EXR_ERR_SUCCESS)
        return true;
    if (result == EXR_ERR_FEATURE_NOT_IMPLEMENTED)
        return refuse(f,
                      "the EXR file's compression (DWAA or DWAB) is one that "
                      "this OpenEXR library cannot read, expected another");
    return error_set(f->err, "%s: the EXR file is damaged or truncated: %s: %s",
                     f->path, what, exr_get_default_error_message(result));
}

//> exr.header: Which pictures are read
static bool check_kind(struct exr_file *f)
{
    int parts;
    exr_storage_t storage;
    if (!is_fine(f, exr_get_count(f->context, &parts), "header"))
        return false;
    if (parts != 1)
        return refuse(f, "the EXR file has several parts, expected one");
    if (!is_fine(f, exr_get_storage(f->context, 0, &storage), "header"))
        return false;
    return storage == EXR_STORAGE_SCANLINE || storage == EXR_STORAGE_TILED ||
           refuse(f, "the EXR file is deep, expected one value a pixel");
}

static struct window window_of(exr_attr_box2i_t box)
{
    struct window w = {box.min.x, box.min.y, box.max.x, box.max.y};
    return w;
}

static bool check_window(struct exr_file *f, const struct window *w,
                         const char *what)
{
    return image_size_is_fine(f->path, what, w->x1 - w->x0 + 1,
                              w->y1 - w->y0 + 1, f->err);
}

static bool windows_overlap(const struct window *a, const struct window *b)
{
    return a->x0 <= b->x1 && b->x0 <= a->x1 && a->y0 <= b->y1 && b->y0 <= a->y1;
}

static bool read_windows(struct exr_file *f)
{
    exr_attr_box2i_t display, data;
    if (!is_fine(f, exr_get_display_window(f->context, 0, &display),
                 "display window") ||
        !is_fine(f, exr_get_data_window(f->context, 0, &data), "data window"))
        return false;
    f->display = window_of(display);
    f->data = window_of(data);
    if (!check_window(f, &f->display, "the EXR file's display window") ||
        !check_window(f, &f->data, "the EXR file's data window"))
        return false;
    return windows_overlap(&f->display, &f->data) ||
           refuse(f, "the EXR file's data window lies outside its display "
                     "window, expected some of the picture inside");
}

static bool has_channel(const exr_attr_chlist_t *channels, const char *name)
{
    for (int i = 0; i < channels->num_channels; i++)
        if (strcmp(channels->entries[i].name.str, name) == 0)
            return true;
    return false;
}

static bool read_channels(struct exr_file *f)
{
    const exr_attr_chlist_t *channels;
    if (!is_fine(f, exr_get_channels(f->context, 0, &channels), "channels"))
        return false;
    for (int i = 0; i < channels->num_channels; i++)
        if (channels->entries[i].x_sampling != 1 ||
            channels->entries[i].y_sampling != 1)
            return refuse(f, "the EXR file has subsampled channels (such as "
                             "RY and BY), expected R, G and B, or Y");
    f->grey = !has_channel(channels, "R");
    if (f->grey ? has_channel(channels, "Y")
                : has_channel(channels, "G") && has_channel(channels, "B"))
        return true;
    return refuse(f, "the EXR file's channels are not R, G and B, nor Y");
}

static bool check_chunk_size(struct exr_file *f)
{
    uint64_t bytes;
    if (!is_fine(f, exr_get_chunk_unpacked_size(f->context, 0, &bytes),
                 "chunks"))
        return false;
    return bytes <= most_chunk_bytes ||
           error_set(f->err,
                     "%s: the EXR file's rows or tiles come in pieces of "
                     "%" PRIu64 " bytes, expected at most %" PRIu64,
                     f->path, bytes, most_chunk_bytes);
}
//< exr.header

//> exr.numbers: From bytes to a component of a pixel
/* Which of a pixel's components a channel fills: first .. end - 1. */
struct components {
    int first, end;
};

static struct components components_of(const struct exr_file *f,
                                       const char *name)
{
    static const char *const names[3] = {"R", "G", "B"};
    struct components all = {0, 3}, none = {0, 0};
    if (f->grey)
        return strcmp(name, "Y") == 0 ? all : none;
    for (int i = 0; i < 3; i++) {
        struct components one = {i, i + 1};
        if (strcmp(name, names[i]) == 0)
            return one;
    }
    return none;
}

static uint32_t little_endian(const uint8_t *bytes, int count)
{
    uint32_t value = 0;
    for (int i = 0; i < count; i++)
        value |= (uint32_t)bytes[i] << (8 * i);
    return value;
}

/* A number as it stands in an unpacked chunk, which is in the file's byte
 * order. */
static float value_at(const uint8_t *bytes, uint16_t type)
{
    if (type == EXR_PIXEL_HALF)
        return half_to_float((uint16_t)little_endian(bytes, 2));
    uint32_t bits = little_endian(bytes, 4);
    float value;
    memcpy(&value, &bits, sizeof value);
    return type == EXR_PIXEL_FLOAT ? value : (float)bits;
}

static void set_component(rgb *pixel, int component, float value)
{
    if (component == 0)
        pixel->r = value;
    else if (component == 1)
        pixel->g = value;
    else
        pixel->b = value;
}
//< exr.numbers

//> exr.unpack: Put the rows of a chunk in their place
/* One channel of one row that begins at the window coordinates x, y. */
static void unpack_row(const struct exr_file *f,
                       const exr_coding_channel_info_t *channel,
                       const uint8_t *bytes, int64_t x, int64_t y)
{
    const struct window *w = &f->display;
    struct components fills = components_of(f, channel->channel_name);
    if (fills.end == 0 || y < w->y0 || y > w->y1)
        return;
    rgb *row = &f->image->pixels[(size_t)(y - w->y0) * (size_t)f->image->width];
    for (int i = 0; i < channel->width; i++) {
        const uint8_t *from = bytes + (size_t)i * channel->bytes_per_element;
        int64_t column = x + i - w->x0;
        bool inside = column >= 0 && column < f->image->width;
        for (int c = fills.first; inside && c < fills.end; c++)
            set_component(&row[column], c, value_at(from, channel->data_type));
    }
}

/* An unpacked chunk: row by row, in each row channel by channel. */
static void unpack_chunk(const struct exr_file *f,
                         const exr_decode_pipeline_t *decoder, int64_t x,
                         int64_t y)
{
    const uint8_t *bytes = decoder->unpacked_buffer;
    for (int row = 0; row < decoder->chunk.height; row++)
        for (int i = 0; i < decoder->channel_count; i++) {
            const exr_coding_channel_info_t *channel = &decoder->channels[i];
            unpack_row(f, channel, bytes, x, y + row);
            bytes += (size_t)channel->width * channel->bytes_per_element;
        }
}
//< exr.unpack

//> exr.decode: Let the library decompress a chunk
/* Does the unpacked chunk hold as many bytes as unpack_chunk reads, and will
 * the library fill them? What is not compressed it does not check. */
static bool chunk_is_whole(const exr_decode_pipeline_t *decoder)
{
    const exr_chunk_info_t *chunk = &decoder->chunk;
    uint64_t row = 0;
    for (int i = 0; i < decoder->channel_count; i++)
        row += (uint64_t)decoder->channels[i].width *
               (uint64_t)decoder->channels[i].bytes_per_element;
    return chunk->width > 0 && chunk->height > 0 &&
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

/* The library reads and decompresses, but for two things. Its own unpacking of
 * half floats writes through the null pointer of a channel that nobody wants.
 * And a chunk that compression would not make shorter stands in the file as it
 * is, which 3.1 forgets for B44. */
static exr_result_t decode(const struct exr_file *f,
                           exr_decode_pipeline_t *decoder)
{
    if (!chunk_is_whole(decoder))
        return EXR_ERR_BAD_CHUNK_LEADER;
    exr_result_t result =
        exr_decoding_choose_default_routines(f->context, 0, decoder);
    decoder->unpack_and_convert_fn = leave_unpacked;
    if (decoder->chunk.packed_size == decoder->chunk.unpacked_size)
        decoder->decompress_fn = NULL;
    if (result == EXR_ERR_SUCCESS)
        result = exr_decoding_run(f->context, 0, decoder);
    return result;
}

/* The chunk whose first pixel has the window coordinates x, y. */
static bool read_chunk(struct exr_file *f, const exr_chunk_info_t *chunk,
                       int64_t x, int64_t y)
{
    exr_decode_pipeline_t decoder = EXR_DECODE_PIPELINE_INITIALIZER;
    exr_result_t result =
        exr_decoding_initialize(f->context, 0, chunk, &decoder);
    if (result == EXR_ERR_SUCCESS)
        result = decode(f, &decoder);
    if (result == EXR_ERR_SUCCESS)
        unpack_chunk(f, &decoder, x, y);
    exr_decoding_destroy(f->context, &decoder);
    return is_fine(f, result, "pixels");
}
//< exr.decode

//> exr.chunks: All chunks, in rows or in tiles
static bool read_scanlines(struct exr_file *f)
{
    int32_t rows;
    if (!is_fine(f, exr_get_scanlines_per_chunk(f->context, 0, &rows), "rows"))
        return false;
    for (int64_t y = f->data.y0; y <= f->data.y1; y += rows) {
        exr_chunk_info_t chunk;
        exr_result_t result =
            exr_read_scanline_chunk_info(f->context, 0, (int)y, &chunk);
        if (!is_fine(f, result, "rows") ||
            !read_chunk(f, &chunk, f->data.x0, y))
            return false;
    }
    return true;
}

/* Tiles count from the data window's upper left corner. */
static bool read_tile(struct exr_file *f, int column, int row, int64_t x,
                      int64_t y)
{
    exr_chunk_info_t chunk;
    exr_result_t result =
        exr_read_tile_chunk_info(f->context, 0, column, row, 0, 0, &chunk);
    return is_fine(f, result, "tiles") && read_chunk(f, &chunk, x, y);
}

static bool read_tiles(struct exr_file *f)
{
    uint32_t width, height;
    exr_tile_level_mode_t levels;
    exr_tile_round_mode_t rounding;
    exr_result_t result = exr_get_tile_descriptor(f->context, 0, &width,
                                                  &height, &levels, &rounding);
    if (!is_fine(f, result, "tiles"))
        return false;
    if (width < 1 || height < 1 || width > INT32_MAX || height > INT32_MAX)
        return refuse(f, "the EXR file's tiles have no size");
    int64_t y = f->data.y0, x;
    for (int row = 0; y <= f->data.y1; row++, y += height) {
        x = f->data.x0;
        for (int column = 0; x <= f->data.x1; column++, x += width)
            if (!read_tile(f, column, row, x, y))
                return false;
    }
    return true;
}

static bool read_pixels(struct exr_file *f)
{
    exr_storage_t storage;
    if (!is_fine(f, exr_get_storage(f->context, 0, &storage), "header"))
        return false;
    return storage == EXR_STORAGE_TILED ? read_tiles(f) : read_scanlines(f);
}
//< exr.chunks

static bool read_file(struct exr_file *f)
{
    if (!check_kind(f) || !read_windows(f) || !read_channels(f) ||
        !check_chunk_size(f))
        return false;
    *f->image = image_make((int)(f->display.x1 - f->display.x0 + 1),
                           (int)(f->display.y1 - f->display.y0 + 1));
    bool fine = read_pixels(f);
    if (!fine)
        image_free(f->image);
    return fine;
}

bool exr_read(const char *path, struct image *out, struct error *err)
{
    struct exr_file f;
    exr_context_initializer_t options = EXR_DEFAULT_CONTEXT_INITIALIZER;
    memset(&f, 0, sizeof f);
    f.path = path;
    f.err = err;
    f.image = out;
    options.error_handler_fn = silent;
    /* Zeros: what a damaged chunk leaves unwritten is black, and not what was
     * in memory. */
    options.alloc_fn = mem_alloc_bytes;
    options.free_fn = mem_free;
    options.max_image_width = IMAGE_MOST_PIXELS;
    options.max_image_height = IMAGE_MOST_PIXELS;
    options.flags = EXR_CONTEXT_FLAG_DISABLE_CHUNK_RECONSTRUCTION;
    if (!is_fine(&f, exr_start_read(&f.context, path, &options), "header"))
        return false;
    bool fine = read_file(&f);
    exr_finish(&f.context);
    return fine;
}
