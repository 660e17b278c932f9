/* exr.c - see exr.h. */
#include "image/exr.h"

#include <OpenEXR/openexr.h>
#include <stdint.h>
#include <stdio.h>

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

static exr_result_t add_channels(exr_context_t file, int part)
{
    static const char *const names[3] = {"B", "G", "R"};
    exr_result_t result = EXR_ERR_SUCCESS;
    for (int i = 0; i < 3 && result == EXR_ERR_SUCCESS; i++)
        result =
            (exr_result_t)exr_add_channel(file, part, names[i], EXR_PIXEL_FLOAT,
                                          EXR_PERCEPTUALLY_LINEAR, 1, 1);
    return result;
}

static exr_result_t write_header(exr_context_t file, int width, int height,
                                 const struct exr_attribute attributes[],
                                 int attribute_count)
{
    int part;
    exr_result_t result =
        exr_add_part(file, "image", EXR_STORAGE_SCANLINE, &part);
    if (result == EXR_ERR_SUCCESS)
        result = exr_initialize_required_attr_simple(file, part, width, height,
                                                     EXR_COMPRESSION_ZIP);
    if (result == EXR_ERR_SUCCESS)
        result = add_channels(file, part);
    if (result == EXR_ERR_SUCCESS)
        result = exr_set_zip_compression_level(file, part, ZIP_LEVEL);
    for (int i = 0; i < attribute_count && result == EXR_ERR_SUCCESS; i++)
        result = exr_attr_set_string(file, part, attributes[i].name,
                                     attributes[i].value);
    if (result == EXR_ERR_SUCCESS)
        result = exr_write_header(file);
    return result;
}

/* Points each of the encoder's channels into the image. Channels come sorted
 * by name, and the pointers must be set anew for every chunk. */
static void point_channels(exr_encode_pipeline_t *encoder,
                           const struct image *image, int first_row)
{
    const rgb *row = &image->pixels[(size_t)first_row * (size_t)image->width];
    for (int i = 0; i < encoder->channel_count; i++) {
        exr_coding_channel_info_t *channel = &encoder->channels[i];
        char name = channel->channel_name[0];
        const float *from = name == 'R'   ? &row->r
                            : name == 'G' ? &row->g
                                          : &row->b;
        channel->encode_from_ptr = (const uint8_t *)from;
        channel->user_pixel_stride = (int32_t)sizeof(rgb);
        channel->user_line_stride = (int32_t)sizeof(rgb) * image->width;
        channel->user_bytes_per_element = (int16_t)sizeof(float);
        channel->user_data_type = EXR_PIXEL_FLOAT;
    }
}

static exr_result_t write_chunk(exr_context_t file, const struct image *image,
                                int first_row, exr_encode_pipeline_t *encoder)
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
    point_channels(encoder, image, first_row);
    if (first)
        result = exr_encoding_choose_default_routines(file, 0, encoder);
    if (result == EXR_ERR_SUCCESS)
        result = exr_encoding_run(file, 0, encoder);
    return result;
}

static exr_result_t write_pixels(exr_context_t file, const struct image *image)
{
    int32_t rows;
    exr_encode_pipeline_t encoder = EXR_ENCODE_PIPELINE_INITIALIZER;
    exr_result_t result = exr_get_scanlines_per_chunk(file, 0, &rows);
    for (int y = 0; y < image->height && result == EXR_ERR_SUCCESS; y += rows)
        result = write_chunk(file, image, y, &encoder);
    exr_encoding_destroy(file, &encoder);
    return result;
}

static exr_result_t write_file(const char *path, const struct image *image,
                               const struct exr_attribute attributes[],
                               int attribute_count)
{
    exr_context_t file;
    exr_context_initializer_t options = EXR_DEFAULT_CONTEXT_INITIALIZER;
    options.error_handler_fn = silent;
    exr_result_t result =
        exr_start_write(&file, path, EXR_WRITE_FILE_DIRECTLY, &options);
    if (result != EXR_ERR_SUCCESS)
        return result;
    result = write_header(file, image->width, image->height, attributes,
                          attribute_count);
    if (result == EXR_ERR_SUCCESS)
        result = write_pixels(file, image);
    exr_result_t closed = exr_finish(&file);
    return result != EXR_ERR_SUCCESS ? result : closed;
}

bool exr_write(const char *path, const struct image *image,
               const struct exr_attribute attributes[], int attribute_count,
               struct error *err)
{
    struct replacement aside;
    if (!replace_begin(&aside, path, err))
        return false;
    exr_result_t result =
        write_file(aside.temporary, image, attributes, attribute_count);
    if (result == EXR_ERR_SUCCESS)
        return replace_commit(&aside, err);
    replace_abandon(&aside);
    return error_set(err, "%s: cannot write the image: %s", path,
                     exr_get_default_error_message(result));
}
