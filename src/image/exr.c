/* exr.c - see exr.h. */
#include "image/exr.h"

#include <OpenEXR/openexr.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "image/replace.h"

/* Level 4 of zlib writes 2.7 times as fast as the default (200 ms instead of
 * 542 ms for a film of 1920 x 1080) and files a few per cent larger. */
enum { ZIP_LEVEL = 4 };

/* OpenEXRCore would print its own errors; ours go through struct error. */
static void silent(exr_const_context_t file, exr_result_t code,
                   const char *message)
{
    (void)file, (void)code, (void)message;
}

/* All that goes into the file. */
struct contents {
    int width, height;
    const struct exr_channel *channels;
    int channel_count;
    const struct exr_attribute *attributes;
    int attribute_count;
};

static exr_result_t add_channels(exr_context_t file, int part,
                                 const struct contents *c)
{
    exr_result_t result = EXR_ERR_SUCCESS;
    for (int i = 0; i < c->channel_count && result == EXR_ERR_SUCCESS; i++)
        result = (exr_result_t)exr_add_channel(file, part, c->channels[i].name,
                                               EXR_PIXEL_FLOAT,
                                               EXR_PERCEPTUALLY_LINEAR, 1, 1);
    return result;
}

static exr_result_t write_header(exr_context_t file, const struct contents *c)
{
    int part;
    exr_result_t result =
        exr_add_part(file, "image", EXR_STORAGE_SCANLINE, &part);
    if (result == EXR_ERR_SUCCESS)
        result = exr_initialize_required_attr_simple(
            file, part, c->width, c->height, EXR_COMPRESSION_ZIP);
    if (result == EXR_ERR_SUCCESS)
        result = add_channels(file, part, c);
    if (result == EXR_ERR_SUCCESS)
        result = exr_set_zip_compression_level(file, part, ZIP_LEVEL);
    for (int i = 0; i < c->attribute_count && result == EXR_ERR_SUCCESS; i++)
        result = exr_attr_set_string(file, part, c->attributes[i].name,
                                     c->attributes[i].value);
    if (result == EXR_ERR_SUCCESS)
        result = exr_write_header(file);
    return result;
}

static const struct exr_channel *find_channel(const struct contents *c,
                                              const char *name)
{
    const struct exr_channel *channel = c->channels;
    while (strcmp(channel->name, name) != 0)
        channel++; /* it is there: the file's channels are ours */
    return channel;
}

/* Points each of the encoder's channels to our values. The file's channels are
 * sorted by name, and the pointers must be set anew for every chunk. */
static void point_channels(exr_encode_pipeline_t *encoder,
                           const struct contents *c, int first_row)
{
    for (int i = 0; i < encoder->channel_count; i++) {
        exr_coding_channel_info_t *to = &encoder->channels[i];
        const struct exr_channel *from = find_channel(c, to->channel_name);
        size_t skipped = (size_t)first_row * (size_t)c->width;
        to->encode_from_ptr =
            (const uint8_t *)(from->values + skipped * (size_t)from->stride);
        to->user_pixel_stride = from->stride * (int32_t)sizeof(float);
        to->user_line_stride = to->user_pixel_stride * c->width;
        to->user_bytes_per_element = (int16_t)sizeof(float);
        to->user_data_type = EXR_PIXEL_FLOAT;
    }
}

/* The library's own function that compresses a chunk. */
struct compressor {
    exr_result_t (*compress)(exr_encode_pipeline_t *);
};

/* For readers, a chunk of as many bytes as its pixels take is not compressed.
 * OpenEXRCore, 3.4.7 too, leaves compressed bytes there when compression
 * keeps the size exactly, which reads as noise (OpenEXR issue 2306). */
static exr_result_t compress_or_store(exr_encode_pipeline_t *encoder)
{
    const struct compressor *library = encoder->encoding_user_data;
    exr_result_t result = library->compress(encoder);
    if (result == EXR_ERR_SUCCESS &&
        encoder->compressed_bytes == encoder->packed_bytes)
        memcpy(encoder->compressed_buffer, encoder->packed_buffer,
               encoder->packed_bytes);
    return result;
}

static exr_result_t choose_routines(exr_context_t file,
                                    struct compressor *library,
                                    exr_encode_pipeline_t *encoder)
{
    exr_result_t result =
        exr_encoding_choose_default_routines(file, 0, encoder);
    library->compress = encoder->compress_fn;
    encoder->compress_fn = compress_or_store;
    encoder->encoding_user_data = library;
    return result;
}

static exr_result_t write_chunk(exr_context_t file, const struct contents *c,
                                int first_row, struct compressor *library,
                                exr_encode_pipeline_t *encoder)
{
    exr_chunk_info_t chunk;
    exr_result_t result =
        exr_write_scanline_chunk_info(file, 0, first_row, &chunk);
    if (result != EXR_ERR_SUCCESS)
        return result;
    bool first = first_row == 0;
    result = first ? exr_encoding_initialize(file, 0, &chunk, encoder)
                   : exr_encoding_update(file, 0, &chunk, encoder);
    if (result != EXR_ERR_SUCCESS)
        return result;
    point_channels(encoder, c, first_row);
    if (first)
        result = choose_routines(file, library, encoder);
    if (result == EXR_ERR_SUCCESS)
        result = exr_encoding_run(file, 0, encoder);
    return result;
}

static exr_result_t write_pixels(exr_context_t file, const struct contents *c)
{
    int32_t rows;
    struct compressor library = {NULL};
    exr_encode_pipeline_t encoder = EXR_ENCODE_PIPELINE_INITIALIZER;
    exr_result_t result = exr_get_scanlines_per_chunk(file, 0, &rows);
    for (int y = 0; y < c->height && result == EXR_ERR_SUCCESS; y += rows)
        result = write_chunk(file, c, y, &library, &encoder);
    exr_encoding_destroy(file, &encoder);
    return result;
}

static exr_result_t write_file(const char *path, const struct contents *c)
{
    exr_context_t file;
    exr_context_initializer_t options = EXR_DEFAULT_CONTEXT_INITIALIZER;
    options.error_handler_fn = silent;
    options.alloc_fn = mem_alloc_bytes;
    options.free_fn = mem_free;
    exr_result_t result =
        exr_start_write(&file, path, EXR_WRITE_FILE_DIRECTLY, &options);
    if (result != EXR_ERR_SUCCESS)
        return result;
    result = write_header(file, c);
    if (result == EXR_ERR_SUCCESS)
        result = write_pixels(file, c);
    exr_result_t closed = exr_finish(&file);
    return result != EXR_ERR_SUCCESS ? result : closed;
}

bool exr_write_channels(const char *path, int width, int height,
                        const struct exr_channel channels[], int channel_count,
                        const struct exr_attribute attributes[],
                        int attribute_count, struct error *err)
{
    const struct contents c = {width,         height,     channels,
                               channel_count, attributes, attribute_count};
    struct replacement aside;
    if (!replace_begin(&aside, path, err))
        return false;
    exr_result_t result = write_file(aside.temporary, &c);
    if (result == EXR_ERR_SUCCESS)
        return replace_commit(&aside, err);
    replace_abandon(&aside);
    return error_set(err, "%s: cannot write the image: %s", path,
                     exr_get_default_error_message(result));
}

bool exr_write(const char *path, const struct image *image,
               const struct exr_attribute attributes[], int attribute_count,
               struct error *err)
{
    const struct exr_channel channels[] = {{"R", &image->pixels->r, 3},
                                           {"G", &image->pixels->g, 3},
                                           {"B", &image->pixels->b, 3}};
    return exr_write_channels(path, image->width, image->height, channels, 3,
                              attributes, attribute_count, err);
}
