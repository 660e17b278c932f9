/* test_read_exr.c - EXR files of every kind, and what is refused. */
#define _POSIX_C_SOURCE 200809L

#include <OpenEXR/openexr.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <unity.h>

#include "image/exr.h"
#include "image/half.h"
#include "image/read.h"

/* ---- a temporary folder with one file in it ---- */

static char folder[] = "/tmp/raybook-exr-XXXXXX";
static char path[64];

void setUp(void)
{
    strcpy(folder, "/tmp/raybook-exr-XXXXXX");
    TEST_ASSERT_NOT_NULL(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/image", folder);
}

void tearDown(void)
{
    remove(path);
    rmdir(folder);
}

/* ---- any EXR file, written by OpenEXRCore ---- */

struct recipe {
    const char *channels; /* a letter each, in the order of the alphabet */
    exr_pixel_type_t type;
    exr_compression_t compression;
    int tile;                       /* 0: scanlines */
    exr_attr_box2i_t display, data; /* all zero: WIDTH x HEIGHT */
    exr_tile_level_mode_t levels;
    int parts;    /* 0: one */
    int sampling; /* 0: 1 */
    bool deep;
    bool header_only;
};

enum { WIDTH = 45, HEIGHT = 37 };

/* What channel c has at the window coordinates x, y: a whole number that half,
 * float and uint hold exactly. */
static int value_of(char c, int x, int y)
{
    return ((c - 'A') * 20 + x * 5 + y * 3) & 1023;
}

static uint16_t half_of(int value)
{
    for (int bits = 0; bits < 0x7c00; bits++)
        if (half_to_float((uint16_t)bits) == (float)value)
            return (uint16_t)bits;
    TEST_FAIL_MESSAGE("not a half");
    return 0;
}

static uint32_t bits_of(int value, exr_pixel_type_t type)
{
    static uint16_t halves[1024];
    float as_float = (float)value;
    uint32_t bits = (uint32_t)value;
    if (halves[1] == 0)
        for (int i = 0; i < 1024; i++)
            halves[i] = half_of(i);
    if (type == EXR_PIXEL_HALF)
        bits = halves[value];
    if (type == EXR_PIXEL_FLOAT)
        memcpy(&bits, &as_float, sizeof bits);
    return bits;
}

static void good(exr_result_t result)
{
    TEST_ASSERT_EQUAL_STRING("", result == EXR_ERR_SUCCESS
                                     ? ""
                                     : exr_get_default_error_message(result));
}

static void write_header(exr_context_t file, const struct recipe *r, int parts)
{
    exr_attr_v2f_t centre = {{{0.0f, 0.0f}}};
    static const char *const names[] = {"one", "two"};
    exr_storage_t storage = r->deep       ? EXR_STORAGE_DEEP_SCANLINE
                            : r->tile > 0 ? EXR_STORAGE_TILED
                                          : EXR_STORAGE_SCANLINE;
    for (int p = 0; p < parts; p++) {
        int part;
        int32_t s = r->sampling > 0 ? r->sampling : 1;
        good(exr_add_part(file, names[p], storage, &part));
        good(exr_initialize_required_attr(
            file, part, &r->display, &r->data, 1.0f, &centre, 1.0f,
            EXR_LINEORDER_INCREASING_Y, r->compression));
        if (r->deep)
            good(exr_set_version(file, part, 1));
        if (r->tile > 0)
            good(exr_set_tile_descriptor(file, part, (uint32_t)r->tile,
                                         (uint32_t)r->tile, r->levels,
                                         EXR_TILE_ROUND_DOWN));
        for (const char *c = r->channels; *c != '\0'; c++) {
            char name[2] = {*c, '\0'};
            good((exr_result_t)exr_add_channel(
                file, part, name, r->type, EXR_PERCEPTUALLY_LOGARITHMIC, s, s));
        }
    }
    good(exr_write_header(file));
}

/* The chunk's pixels, channel after channel, from the window coordinates. */
static void write_chunk(exr_context_t file, const struct recipe *r,
                        const exr_chunk_info_t *chunk, int x0, int y0)
{
    static uint8_t planes[8][64 * 64 * 4];
    int bytes = r->type == EXR_PIXEL_HALF ? 2 : 4;
    exr_encode_pipeline_t encoder = EXR_ENCODE_PIPELINE_INITIALIZER;
    good(exr_encoding_initialize(file, 0, chunk, &encoder));
    for (int c = 0; c < encoder.channel_count; c++) {
        exr_coding_channel_info_t *channel = &encoder.channels[c];
        for (int i = 0; i < chunk->width * chunk->height; i++) {
            uint32_t bits =
                bits_of(value_of(r->channels[c], x0 + i % chunk->width,
                                 y0 + i / chunk->width),
                        r->type);
            memcpy(&planes[c][i * bytes], &bits, (size_t)bytes);
        }
        channel->encode_from_ptr = planes[c];
        channel->user_pixel_stride = bytes;
        channel->user_line_stride = bytes * chunk->width;
        channel->user_bytes_per_element = (int16_t)bytes;
        channel->user_data_type = (uint16_t)r->type;
    }
    good(exr_encoding_choose_default_routines(file, 0, &encoder));
    good(exr_encoding_run(file, 0, &encoder));
    exr_encoding_destroy(file, &encoder);
}

static void write_scanlines(exr_context_t file, const struct recipe *r)
{
    int32_t rows;
    exr_chunk_info_t chunk;
    good(exr_get_scanlines_per_chunk(file, 0, &rows));
    for (int y = r->data.min.y; y <= r->data.max.y; y += rows) {
        good(exr_write_scanline_chunk_info(file, 0, y, &chunk));
        write_chunk(file, r, &chunk, r->data.min.x, y);
    }
}

static void write_tiles(exr_context_t file, const struct recipe *r)
{
    exr_chunk_info_t chunk;
    int32_t levels_x = 1, levels_y = 1, width, height;
    good(exr_get_tile_levels(file, 0, &levels_x, &levels_y));
    for (int level = 0; level < levels_x; level++) {
        good(exr_get_level_sizes(file, 0, level, level, &width, &height));
        for (int y = 0; y * r->tile < height; y++)
            for (int x = 0; x * r->tile < width; x++) {
                good(exr_write_tile_chunk_info(file, 0, x, y, level, level,
                                               &chunk));
                /* levels other than 0 get pixels from elsewhere */
                write_chunk(file, r, &chunk,
                            r->data.min.x + x * r->tile + 100 * level,
                            r->data.min.y + y * r->tile);
            }
    }
}

/* exr_finish removes a file that it finds without pixels: it gets a second
 * name. */
static char kept[80];

static void keep_unfinished(void)
{
    snprintf(kept, sizeof kept, "%s-kept", path);
    TEST_ASSERT_EQUAL_INT(0, link(path, kept));
}

static void silent(exr_const_context_t context, exr_result_t code,
                   const char *message)
{
    (void)context, (void)code, (void)message;
}

static void write_exr(struct recipe r)
{
    exr_context_t file;
    exr_context_initializer_t options = EXR_DEFAULT_CONTEXT_INITIALIZER;
    exr_attr_box2i_t whole = {{{{0, 0}}}, {{{WIDTH - 1, HEIGHT - 1}}}};
    if (r.data.max.x == 0 && r.data.min.x == 0)
        r.display = r.data = whole;
    options.error_handler_fn = silent;
    good(exr_start_write(&file, path, EXR_WRITE_FILE_DIRECTLY, &options));
    write_header(file, &r, r.parts > 0 ? r.parts : 1);
    if (r.header_only)
        keep_unfinished();
    else if (r.tile > 0)
        write_tiles(file, &r);
    else
        write_scanlines(file, &r);
    exr_finish(&file);
    if (r.header_only)
        TEST_ASSERT_EQUAL_INT(0, rename(kept, path));
}

/* ---- reading ---- */

static struct image read_fine(void)
{
    struct image image;
    struct error err = {""};
    bool fine = image_read(path, ENCODING_AUTO, &image, &err);
    TEST_ASSERT_TRUE_MESSAGE(fine, err.text);
    return image;
}

static void check_refused(const char *words)
{
    struct image image;
    struct error err = {""};
    TEST_ASSERT_FALSE(image_read(path, ENCODING_AUTO, &image, &err));
    TEST_ASSERT_NULL(image.pixels);
    TEST_ASSERT_EQUAL_INT(0, strncmp(err.text, path, strlen(path)));
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(err.text, words), err.text);
}

/* The image whose first pixel is x0, y0: value_of in the data window, each
 * within a part of it, and 0 elsewhere. */
static void check_image(const struct image *image, const struct recipe *r,
                        int x0, int y0, float part)
{
    bool grey = strchr(r->channels, 'R') == NULL;
    for (int i = 0; i < image->width * image->height; i++) {
        int x = x0 + i % image->width, y = y0 + i / image->width;
        bool in =
            r->data.max.x == 0 || (x >= r->data.min.x && x <= r->data.max.x &&
                                   y >= r->data.min.y && y <= r->data.max.y);
        const float got[3] = {image->pixels[i].r, image->pixels[i].g,
                              image->pixels[i].b};
        for (int c = 0; c < 3; c++) {
            int want = in ? value_of(grey ? 'Y' : "RGB"[c], x, y) : 0;
            TEST_ASSERT_FLOAT_WITHIN(part * 1023.0f, (float)want, got[c]);
        }
    }
}

static void check_recipe(struct recipe r, float part)
{
    write_exr(r);
    struct image image = read_fine();
    TEST_ASSERT_EQUAL_INT(WIDTH, image.width);
    TEST_ASSERT_EQUAL_INT(HEIGHT, image.height);
    check_image(&image, &r, 0, 0, part);
    image_free(&image);
}

static void test_what_exr_write_writes_comes_back_bit_for_bit(void)
{
    struct error err = {""};
    struct image image = image_make(WIDTH, HEIGHT);
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        image.pixels[i] =
            rgb_make(ldexpf(1.0f + 1e-3f * (float)i, i % 250 - 125),
                     0x1p-149f * (float)i, 3e38f / (float)(1 + i));
    TEST_ASSERT_TRUE(exr_write(path, &image, NULL, 0, &err));
    struct image back = read_fine();
    TEST_ASSERT_EQUAL_INT(WIDTH, back.width);
    TEST_ASSERT_EQUAL_INT(HEIGHT, back.height);
    TEST_ASSERT_EQUAL_MEMORY(image.pixels, back.pixels,
                             sizeof(rgb) * WIDTH * HEIGHT);
    image_free(&image);
    image_free(&back);
}

static void test_every_type_compression_and_storage(void)
{
    static const exr_pixel_type_t types[] = {EXR_PIXEL_HALF, EXR_PIXEL_FLOAT,
                                             EXR_PIXEL_UINT};
    for (int c = EXR_COMPRESSION_NONE; c <= EXR_COMPRESSION_PXR24; c++)
        for (int t = 0; t < 3; t++)
            for (int tile = 0; tile <= 32; tile += 16) {
                struct recipe r = {.channels = "BGR",
                                   .type = types[t],
                                   .compression = (exr_compression_t)c,
                                   .tile = tile};
                check_recipe(r, 0.0f);
            }
}

/* B44 changes half floats a little. */
static void test_lossy_compressions(void)
{
    for (int c = EXR_COMPRESSION_B44; c <= EXR_COMPRESSION_B44A; c++)
        for (int tile = 0; tile <= 32; tile += 32) {
            struct recipe r = {.channels = "BGR",
                               .type = EXR_PIXEL_HALF,
                               .compression = (exr_compression_t)c,
                               .tile = tile};
            check_recipe(r, 0.02f);
        }
}

/* Changes what the file's header says of its compression. */
static void claim_compression(exr_compression_t compression)
{
    static const char name[] = "compression\0compression\0\1\0\0";
    uint8_t bytes[4096];
    FILE *file = fopen(path, "rb+");
    size_t size = fread(bytes, 1, sizeof bytes, file), at = 0;
    while (at + sizeof name < size &&
           memcmp(&bytes[at], name, sizeof name) != 0)
        at++;
    TEST_ASSERT_TRUE(at + sizeof name < size);
    fseek(file, (long)(at + sizeof name), SEEK_SET);
    fputc(compression, file);
    fclose(file);
}

/* A chunk as long as its pixels is not compressed, whatever the header says:
 * other programs store it so when compression does not pay. */
static void test_chunks_that_are_stored_as_they_are(void)
{
    for (int c = EXR_COMPRESSION_NONE; c <= EXR_COMPRESSION_B44A; c++)
        for (int t = EXR_PIXEL_UINT; t <= EXR_PIXEL_FLOAT; t++) {
            struct recipe r = {.channels = "BGR",
                               .type = (exr_pixel_type_t)t,
                               .compression = EXR_COMPRESSION_NONE,
                               .tile = 16};
            write_exr(r);
            claim_compression((exr_compression_t)c);
            struct image image = read_fine();
            check_image(&image, &r, 0, 0, 0.0f);
            image_free(&image);
        }
}

/* OpenEXRCore 3.1 can neither write nor read DWAA and DWAB: a file that only
 * says that it is such a one. */
static void test_a_compression_that_the_library_lacks(void)
{
    struct recipe r = {.channels = "BGR",
                       .type = EXR_PIXEL_FLOAT,
                       .compression = EXR_COMPRESSION_PIZ};
    int major, minor;
    exr_get_library_version(&major, &minor, NULL, NULL);
    if (major != 3 || minor != 1)
        TEST_IGNORE_MESSAGE("a library that can");
    write_exr(r);
    claim_compression(EXR_COMPRESSION_DWAA);
    check_refused("DWAA");
}

static void test_other_channels_are_passed_over(void)
{
    static const char *const channels[] = {"ABGR", "ABGRZ", "BGRZ",
                                           "Y",    "AY",    "AYZ"};
    for (int i = 0; i < 6; i++)
        for (int t = EXR_PIXEL_UINT; t <= EXR_PIXEL_FLOAT; t++) {
            struct recipe r = {.channels = channels[i],
                               .type = (exr_pixel_type_t)t,
                               .compression = EXR_COMPRESSION_ZIP};
            check_recipe(r, 0.0f);
        }
}

static void test_the_largest_of_several_levels(void)
{
    struct recipe r = {.channels = "BGR",
                       .type = EXR_PIXEL_FLOAT,
                       .compression = EXR_COMPRESSION_ZIP,
                       .tile = 16,
                       .levels = EXR_TILE_MIPMAP_LEVELS};
    check_recipe(r, 0.0f);
}

/* ---- windows ---- */

static void check_windows(int x0, int y0, int x1, int y1)
{
    exr_attr_box2i_t display = {{{{-3, 4}}}, {{{16, 23}}}};
    exr_attr_box2i_t data = {{{{x0, y0}}}, {{{x1, y1}}}};
    for (int tile = 0; tile <= 16; tile += 16) {
        struct recipe r = {.channels = "BGR",
                           .type = EXR_PIXEL_HALF,
                           .compression = EXR_COMPRESSION_ZIP,
                           .tile = tile,
                           .display = display,
                           .data = data};
        write_exr(r);
        struct image image = read_fine();
        TEST_ASSERT_EQUAL_INT(20, image.width);
        TEST_ASSERT_EQUAL_INT(20, image.height);
        check_image(&image, &r, -3, 4, 0.0f);
        image_free(&image);
    }
}

static void test_data_windows(void)
{
    check_windows(-3, 4, 16, 23);  /* the same */
    check_windows(0, 7, 5, 11);    /* smaller */
    check_windows(-9, -5, 30, 40); /* larger */
    check_windows(-9, 10, 2, 40);  /* over a corner */
    check_windows(16, 23, 40, 30); /* of one pixel in common */
}

static void test_a_data_window_outside_is_refused(void)
{
    struct recipe r = {.channels = "BGR",
                       .compression = EXR_COMPRESSION_ZIP,
                       .display = {{{{0, 0}}}, {{{9, 9}}}},
                       .data = {{{{10, 0}}}, {{{19, 9}}}}};
    write_exr(r);
    check_refused("data window lies outside");
}

static void test_huge_windows_are_refused(void)
{
    struct recipe r = {.channels = "BGR",
                       .type = EXR_PIXEL_HALF,
                       .compression = EXR_COMPRESSION_ZIP,
                       .display = {{{{0, 0}}}, {{{99999, 99999}}}},
                       .data = {{{{1, 0}}}, {{{9, 9}}}}};
    write_exr(r);
    check_refused("display window is 100000 x 100000 pixels");
}

/* ---- refused ---- */

static void test_kinds_that_are_refused(void)
{
    struct recipe parts = {.channels = "BGR", .parts = 2, .header_only = true};
    write_exr(parts);
    check_refused("several parts");
    struct recipe deep = {.channels = "BGR", .deep = true, .header_only = true};
    write_exr(deep);
    check_refused("deep");
    struct recipe none = {.channels = "ABG"};
    write_exr(none);
    check_refused("not R, G and B, nor Y");
    struct recipe sampled = {.channels = "Y",
                             .sampling = 2,
                             .display = {{{{0, 0}}}, {{{7, 7}}}},
                             .data = {{{{0, 0}}}, {{{7, 7}}}},
                             .header_only = true};
    write_exr(sampled);
    check_refused("subsampled");
}

static void check_value(int component, float value, const char *words)
{
    struct error err = {""};
    struct image image = image_make(7, 5);
    rgb *pixel = &image.pixels[3 * 7 + 2];
    *(component == 0   ? &pixel->r
      : component == 1 ? &pixel->g
                       : &pixel->b) = value;
    TEST_ASSERT_TRUE(exr_write(path, &image, NULL, 0, &err));
    check_refused(words);
    image_free(&image);
}

static void test_values_that_are_refused(void)
{
    check_value(0, NAN, "pixel (2, 3): red is ");
    check_value(1, INFINITY, "pixel (2, 3): green is inf");
    check_value(2, -0.25f, "pixel (2, 3): blue is -0.25, expected a finite");
    check_value(2, -INFINITY, "pixel (2, 3): blue is -inf");
}

static void test_truncated_files_are_refused(void)
{
    static uint8_t bytes[1 << 17];
    for (int tile = 0; tile <= 16; tile += 16) {
        struct recipe r = {.channels = "BGR",
                           .type = EXR_PIXEL_FLOAT,
                           .compression = EXR_COMPRESSION_PIZ,
                           .tile = tile};
        write_exr(r);
        FILE *file = fopen(path, "rb");
        size_t size = fread(bytes, 1, sizeof bytes, file);
        fclose(file);
        for (size_t part = 4; part < size; part += 1 + size / 300) {
            TEST_ASSERT_EQUAL_INT(0, truncate(path, 0));
            file = fopen(path, "wb");
            fwrite(bytes, 1, part, file);
            fclose(file);
            check_refused("damaged or truncated");
        }
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_what_exr_write_writes_comes_back_bit_for_bit);
    RUN_TEST(test_every_type_compression_and_storage);
    RUN_TEST(test_lossy_compressions);
    RUN_TEST(test_chunks_that_are_stored_as_they_are);
    RUN_TEST(test_a_compression_that_the_library_lacks);
    RUN_TEST(test_other_channels_are_passed_over);
    RUN_TEST(test_the_largest_of_several_levels);
    RUN_TEST(test_data_windows);
    RUN_TEST(test_a_data_window_outside_is_refused);
    RUN_TEST(test_huge_windows_are_refused);
    RUN_TEST(test_kinds_that_are_refused);
    RUN_TEST(test_values_that_are_refused);
    RUN_TEST(test_truncated_files_are_refused);
    return UNITY_END();
}
