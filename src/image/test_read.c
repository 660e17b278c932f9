/* test_read.c - PNG, JPEG and HDR files, and what is refused. */
#define _POSIX_C_SOURCE 200809L

#include "image/read.h"

#include <stb/stb_image_write.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <unity.h>

#include "image/srgb.h"

/* ---- a temporary folder with one file in it ---- */

static char folder[] = "/tmp/raybook-read-XXXXXX";
static char path[64];

void setUp(void)
{
    strcpy(folder, "/tmp/raybook-read-XXXXXX");
    TEST_ASSERT_NOT_NULL(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/image", folder);
}

void tearDown(void)
{
    remove(path);
    rmdir(folder);
}

static void write_bytes(const void *bytes, size_t size)
{
    FILE *file = fopen(path, "wb");
    TEST_ASSERT_NOT_NULL(file);
    TEST_ASSERT_EQUAL_UINT64(size, fwrite(bytes, 1, size, file));
    fclose(file);
}

static size_t read_bytes(uint8_t *bytes, size_t room)
{
    FILE *file = fopen(path, "rb");
    TEST_ASSERT_NOT_NULL(file);
    size_t size = fread(bytes, 1, room, file);
    TEST_ASSERT_TRUE(size < room);
    fclose(file);
    return size;
}

static struct image read_fine(enum image_encoding encoding)
{
    struct image image;
    struct error err = {""};
    bool fine = image_read(path, encoding, &image, &err);
    TEST_ASSERT_TRUE_MESSAGE(fine, err.text);
    TEST_ASSERT_EQUAL_STRING("", err.text);
    return image;
}

/* The file is refused, by a message that begins with its path and has these
 * words in it. */
static void check_refused(enum image_encoding encoding, const char *words)
{
    struct image image;
    struct error err = {""};
    TEST_ASSERT_FALSE(image_read(path, encoding, &image, &err));
    TEST_ASSERT_NULL(image.pixels);
    TEST_ASSERT_EQUAL_INT(0, image.width);
    TEST_ASSERT_EQUAL_INT(0, strncmp(err.text, path, strlen(path)));
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(err.text, words), err.text);
}

/* Any part of the file but the whole is refused. */
static void check_truncations(void)
{
    static uint8_t bytes[65536];
    size_t size = read_bytes(bytes, sizeof bytes);
    for (size_t part = 0; part < size; part += 1 + size / 400) {
        struct image image;
        struct error err = {""};
        write_bytes(bytes, part);
        TEST_ASSERT_FALSE(image_read(path, ENCODING_AUTO, &image, &err));
        TEST_ASSERT_NOT_EQUAL(0, strlen(err.text));
    }
}

/* ---- pictures ---- */

enum { WIDTH = 37, HEIGHT = 21 };

/* Every code occurs; the three components differ. */
static void fill_codes(uint8_t *codes, int channels)
{
    for (int i = 0; i < WIDTH * HEIGHT * channels; i++)
        codes[i] = (uint8_t)(i * 89 >> 2);
}

static void check_codes(const struct image *image, const uint8_t *codes,
                        int channels, bool srgb)
{
    TEST_ASSERT_EQUAL_INT(WIDTH, image->width);
    TEST_ASSERT_EQUAL_INT(HEIGHT, image->height);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const uint8_t *code = &codes[i * channels];
        const float got[3] = {image->pixels[i].r, image->pixels[i].g,
                              image->pixels[i].b};
        for (int c = 0; c < 3; c++) {
            float value = (float)code[channels < 3 ? 0 : c] / 255.0f;
            TEST_ASSERT_EQUAL_FLOAT(srgb ? srgb_decode(value) : value, got[c]);
        }
    }
}

static void check_png(int channels, enum image_encoding encoding, bool srgb)
{
    uint8_t codes[WIDTH * HEIGHT * 4];
    fill_codes(codes, channels);
    TEST_ASSERT_TRUE(stbi_write_png(path, WIDTH, HEIGHT, channels, codes, 0));
    struct image image = read_fine(encoding);
    check_codes(&image, codes, channels, srgb);
    image_free(&image);
}

static void test_png_of_every_channel_count(void)
{
    for (int channels = 1; channels <= 4; channels++)
        check_png(channels, ENCODING_AUTO, true);
}

static void test_png_encodings(void)
{
    check_png(3, ENCODING_SRGB, true);
    check_png(3, ENCODING_LINEAR, false);
}

/* 2 x 1 pixels, 16-bit grey: codes 0x0102 and 0xfffe, in a stored block. */
static const uint8_t png16[] = {
    0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00,
    0x0d, 0x49, 0x48, 0x44, 0x52, 0x00, 0x00, 0x00, 0x02, 0x00, 0x00,
    0x00, 0x01, 0x10, 0x00, 0x00, 0x00, 0x00, 0x81, 0xd9, 0xfc, 0x15,
    0x00, 0x00, 0x00, 0x10, 0x49, 0x44, 0x41, 0x54, 0x78, 0x01, 0x01,
    0x05, 0x00, 0xfa, 0xff, 0x00, 0x01, 0x02, 0xff, 0xfe, 0x03, 0x0b,
    0x02, 0x01, 0x06, 0x90, 0x21, 0x19, 0x00, 0x00, 0x00, 0x00, 0x49,
    0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};

static void test_png_of_16_bits_keeps_them(void)
{
    write_bytes(png16, sizeof png16);
    struct image image = read_fine(ENCODING_LINEAR);
    TEST_ASSERT_EQUAL_INT(2, image.width);
    TEST_ASSERT_EQUAL_FLOAT(258.0f / 65535.0f, image.pixels[0].g);
    TEST_ASSERT_EQUAL_FLOAT(65534.0f / 65535.0f, image.pixels[1].b);
    image_free(&image);
    image = read_fine(ENCODING_AUTO);
    TEST_ASSERT_EQUAL_FLOAT(srgb_decode(258.0f / 65535.0f), image.pixels[0].r);
    image_free(&image);
}

/* A smooth picture, for JPEG: codes 40 .. 40 + 5 x, 3 y + 60, 128. */
static void write_smooth_jpeg(void)
{
    uint8_t codes[WIDTH * HEIGHT * 3];
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        codes[3 * i] = (uint8_t)(40 + 5 * (i % WIDTH));
        codes[3 * i + 1] = (uint8_t)(60 + 3 * (i / WIDTH));
        codes[3 * i + 2] = 128;
    }
    TEST_ASSERT_TRUE(stbi_write_jpg(path, WIDTH, HEIGHT, 3, codes, 95));
}

static void test_jpeg(void)
{
    write_smooth_jpeg();
    struct image image = read_fine(ENCODING_LINEAR);
    TEST_ASSERT_EQUAL_INT(WIDTH, image.width);
    TEST_ASSERT_EQUAL_INT(HEIGHT, image.height);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        rgb p = image.pixels[i];
        TEST_ASSERT_FLOAT_WITHIN(6, (float)(40 + 5 * (i % WIDTH)), p.r * 255);
        TEST_ASSERT_FLOAT_WITHIN(6, (float)(60 + 3 * (i / WIDTH)), p.g * 255);
        TEST_ASSERT_FLOAT_WITHIN(6, 128.0f, p.b * 255);
    }
    image_free(&image);
}

static void test_jpeg_is_srgb(void)
{
    write_smooth_jpeg();
    struct image linear = read_fine(ENCODING_LINEAR);
    struct image decoded = read_fine(ENCODING_AUTO);
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        TEST_ASSERT_EQUAL_FLOAT(srgb_decode(linear.pixels[i].g),
                                decoded.pixels[i].g);
    image_free(&linear);
    image_free(&decoded);
}

static void check_hdr(int width, int height)
{
    float values[100 * 20 * 3];
    for (int i = 0; i < width * height * 3; i++)
        values[i] =
            i % 11 < 5 ? 0.25f : ldexpf(1.0f + 0.01f * (i % 97), i % 30);
    TEST_ASSERT_TRUE(stbi_write_hdr(path, width, height, 3, values));
    struct image image = read_fine(ENCODING_AUTO);
    TEST_ASSERT_EQUAL_INT(width, image.width);
    TEST_ASSERT_EQUAL_INT(height, image.height);
    for (int i = 0; i < width * height; i++) {
        const float *v = &values[3 * i];
        float step = fmaxf(fmaxf(v[0], v[1]), v[2]) / 128.0f;
        TEST_ASSERT_FLOAT_WITHIN(step, v[0], image.pixels[i].r);
        TEST_ASSERT_FLOAT_WITHIN(step, v[1], image.pixels[i].g);
        TEST_ASSERT_FLOAT_WITHIN(step, v[2], image.pixels[i].b);
    }
    image_free(&image);
}

static void test_hdr_flat_and_encoded(void)
{
    check_hdr(5, 3); /* narrow: flat */
    check_hdr(8, 1);
    check_hdr(100, 20);
}

static void write_text(const char *text, size_t size)
{
    write_bytes(text, size);
}

#define WRITE_LITERAL(text) write_text(text, sizeof(text) - 1)
#define HDR_HEADER "#?RGBE\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=2\n\n"

static void test_hdr_pixel_by_hand(void)
{
    WRITE_LITERAL(HDR_HEADER "-Y 1 +X 2\n\x80\x40\x00\x81\x01\x02\x03\x00");
    struct image image = read_fine(ENCODING_LINEAR);
    TEST_ASSERT_EQUAL_FLOAT(1.0f, image.pixels[0].r);
    TEST_ASSERT_EQUAL_FLOAT(0.5f, image.pixels[0].g);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, image.pixels[0].b);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, image.pixels[1].g);
    image_free(&image);
}

/* ---- refused ---- */

static void test_missing_and_not_a_file(void)
{
    check_refused(ENCODING_AUTO, "No such file");
    TEST_ASSERT_EQUAL_INT(0, mkdir(path, 0700));
    check_refused(ENCODING_AUTO, "folder");
    rmdir(path);
}

static void test_not_an_image(void)
{
    WRITE_LITERAL("");
    check_refused(ENCODING_AUTO, "expected EXR, HDR, PNG or JPEG");
    WRITE_LITERAL("GIF89a and more");
    check_refused(ENCODING_AUTO, "expected EXR, HDR, PNG or JPEG");
}

static void test_truncated_png(void)
{
    check_png(3, ENCODING_AUTO, true);
    /* stb_image does not want the checksum after IEND; the rest it does */
    truncate(path, 60);
    check_refused(ENCODING_AUTO, "damaged or truncated");
    write_bytes(png16, sizeof png16 - 12);
    check_truncations();
}

static void test_truncated_jpeg(void)
{
    write_smooth_jpeg();
    check_truncations();
    write_smooth_jpeg();
    truncate(path, 700);
    check_refused(ENCODING_AUTO, "the file ends before the picture");
}

static void test_truncated_hdr(void)
{
    check_hdr(100, 20);
    check_truncations();
    check_hdr(5, 3);
    check_truncations();
    check_hdr(100, 20);
    truncate(path, 1000);
    check_refused(ENCODING_AUTO, "ends in row");
}

static void test_damaged_hdr(void)
{
    WRITE_LITERAL("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\nabcd");
    check_refused(ENCODING_AUTO, "FORMAT=32-bit_rle_rgbe");
    WRITE_LITERAL(HDR_HEADER "+Y 1 +X 1\nabcd");
    check_refused(ENCODING_AUTO, "-Y height +X width");
    WRITE_LITERAL(HDR_HEADER "-Y 0 +X 5\nabcd");
    check_refused(ENCODING_AUTO, "5 x 0 pixels");
    WRITE_LITERAL(HDR_HEADER "-Y -5 +X 5\nabcd");
    check_refused(ENCODING_AUTO, "5 x -5 pixels");
    WRITE_LITERAL(HDR_HEADER "-Y 1048576 +X 1048576\nabcd");
    check_refused(ENCODING_AUTO, "1048576 x 1048576 pixels");
    WRITE_LITERAL(HDR_HEADER "-Y 99999999999 +X 1\nabcd");
    check_refused(ENCODING_AUTO, "-Y height +X width");
    /* a run of length 0 */
    WRITE_LITERAL(HDR_HEADER "-Y 1 +X 9\n\x02\x02\x00\x09\x00\x00\x00\x00");
    check_refused(ENCODING_AUTO, "damaged in row 1 of 1");
    /* a run beyond the row */
    WRITE_LITERAL(HDR_HEADER "-Y 1 +X 9\n\x02\x02\x00\x09\x8a\x00\x00\x00");
    check_refused(ENCODING_AUTO, "damaged in row 1 of 1");
}

static void test_linear_files_are_not_srgb(void)
{
    check_hdr(5, 3);
    check_refused(ENCODING_SRGB, "expected \"auto\" or \"linear\"");
}

static void test_png_that_says_it_is_huge(void)
{
    uint8_t bytes[sizeof png16];
    memcpy(bytes, png16, sizeof png16);
    bytes[17] = bytes[21] = 1; /* 65536 pixels more, each way */
    write_bytes(bytes, sizeof bytes);
    check_refused(ENCODING_AUTO, "65538 x 65537 pixels");
    memcpy(bytes, png16, sizeof png16);
    bytes[19] = 0; /* the width */
    write_bytes(bytes, sizeof bytes);
    check_refused(ENCODING_AUTO, "0 x 1 pixels");
}

/* Where a marker is in a JPEG file's bytes; after its length. */
static size_t segment_of(const uint8_t *bytes, size_t size, uint8_t marker)
{
    for (size_t i = 0; i + 4 < size; i++)
        if (bytes[i] == 0xff && bytes[i + 1] == marker)
            return i + 4;
    TEST_FAIL_MESSAGE("no such segment");
    return 0;
}

/* The JPEG file with one byte changed, so many after a segment's length. */
static void check_jpeg_byte(uint8_t marker, size_t offset, uint8_t value,
                            const char *words)
{
    static uint8_t bytes[65536];
    write_smooth_jpeg();
    size_t size = read_bytes(bytes, sizeof bytes);
    bytes[segment_of(bytes, size, marker) + offset] = value;
    write_bytes(bytes, size);
    check_refused(ENCODING_AUTO, words);
}

static void test_jpegs_that_would_mislead_stb_image(void)
{
    check_jpeg_byte(0xc4, 16, 255, "Huffman table");    /* too many codes */
    check_jpeg_byte(0xc4, 0, 0x01, "table is missing"); /* another number */
    check_jpeg_byte(0xda, 2, 0x23, "table is missing"); /* numbers 2 and 3 */
    check_jpeg_byte(0xda, 1, 77, "component that the frame does not have");
    check_jpeg_byte(0xda, 3, 1, "has no scan"); /* the first one twice */
    check_jpeg_byte(0xc0, 5, 9, "frame's header");
    check_jpeg_byte(0xc0, 4, 0, "0 x 21 pixels");
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_png_of_every_channel_count);
    RUN_TEST(test_png_encodings);
    RUN_TEST(test_png_of_16_bits_keeps_them);
    RUN_TEST(test_jpeg);
    RUN_TEST(test_jpeg_is_srgb);
    RUN_TEST(test_hdr_flat_and_encoded);
    RUN_TEST(test_hdr_pixel_by_hand);
    RUN_TEST(test_missing_and_not_a_file);
    RUN_TEST(test_not_an_image);
    RUN_TEST(test_truncated_png);
    RUN_TEST(test_truncated_jpeg);
    RUN_TEST(test_truncated_hdr);
    RUN_TEST(test_damaged_hdr);
    RUN_TEST(test_linear_files_are_not_srgb);
    RUN_TEST(test_png_that_says_it_is_huge);
    RUN_TEST(test_jpegs_that_would_mislead_stb_image);
    return UNITY_END();
}
