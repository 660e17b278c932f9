/* test_png.c - tests of png.h: the tone curve. The files are read back, PNG
 * and EXR, by the tests in Python. */
#include "image/png.h"

#include <string.h>

#include "image/replace.h"

#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static void ends_are_clipped(void)
{
    TEST_ASSERT_EQUAL_UINT8(0, srgb_encode(0.0f));
    TEST_ASSERT_EQUAL_UINT8(0, srgb_encode(-1.0f));
    TEST_ASSERT_EQUAL_UINT8(0, srgb_encode(-INFINITY));
    TEST_ASSERT_EQUAL_UINT8(255, srgb_encode(1.0f));
    TEST_ASSERT_EQUAL_UINT8(255, srgb_encode(1.5f));
    TEST_ASSERT_EQUAL_UINT8(255, srgb_encode(INFINITY));
}

static void not_a_number_is_black(void)
{
    TEST_ASSERT_EQUAL_UINT8(0, srgb_encode(NAN));
    TEST_ASSERT_EQUAL_UINT8(0, srgb_encode(-NAN));
}

/* Values that are found in every table of the curve. */
static void well_known_codes(void)
{
    TEST_ASSERT_EQUAL_UINT8(188, srgb_encode(0.5f));
    TEST_ASSERT_EQUAL_UINT8(118, srgb_encode(0.18f));
    TEST_ASSERT_EQUAL_UINT8(50, srgb_encode(0.032f));
}

/* The inverse curve, IEC 61966-2-1, in double. */
static double decode(double code)
{
    double c = code / 255.0;
    return c <= 0.04045 ? c / 12.92 : pow((c + 0.055) / 1.055, 2.4);
}

/* Each code stands for the values whose exact code is less than half a step
 * away; its middle must come back, and so must values near its borders. */
static void every_code_comes_back(void)
{
    for (int code = 0; code < 256; code++) {
        TEST_ASSERT_EQUAL_UINT8(code, srgb_encode((float)decode(code)));
        if (code < 255)
            TEST_ASSERT_EQUAL_UINT8(code,
                                    srgb_encode((float)decode(code + 0.49)));
        if (code > 0)
            TEST_ASSERT_EQUAL_UINT8(code,
                                    srgb_encode((float)decode(code - 0.49)));
    }
}

static void brighter_is_never_darker(void)
{
    uint8_t before = 0;
    for (int i = 0; i <= 100000; i++) {
        uint8_t code = srgb_encode((float)i / 100000.0f);
        TEST_ASSERT_TRUE(code >= before);
        before = code;
    }
}

static void a_folder_that_is_missing_is_a_fault(void)
{
    struct error err = {""};
    struct image image = image_make(2, 2);
    TEST_ASSERT_FALSE(png_write("/no/such/folder/a.png", &image, &err));
    TEST_ASSERT_NOT_NULL(strstr(err.text, "/no/such/folder/a.png"));
    image_free(&image);
}

static void a_path_that_is_too_long_is_a_fault(void)
{
    static char path[2 * REPLACE_PATH_SIZE];
    struct error err = {""};
    struct replacement r;
    memset(path, 'a', sizeof path - 1);
    TEST_ASSERT_FALSE(replace_begin(&r, path, &err));
    TEST_ASSERT_NOT_NULL(strstr(err.text, "too long"));
}

static void a_new_image_is_black(void)
{
    struct image image = image_make(3, 5);
    TEST_ASSERT_EQUAL_INT(3, image.width);
    TEST_ASSERT_EQUAL_INT(5, image.height);
    for (int i = 0; i < 15; i++)
        TEST_ASSERT_TRUE(rgb_is_black(image.pixels[i]));
    image_free(&image);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(ends_are_clipped);
    RUN_TEST(not_a_number_is_black);
    RUN_TEST(well_known_codes);
    RUN_TEST(every_code_comes_back);
    RUN_TEST(brighter_is_never_darker);
    RUN_TEST(a_folder_that_is_missing_is_a_fault);
    RUN_TEST(a_path_that_is_too_long_is_a_fault);
    RUN_TEST(a_new_image_is_black);
    return UNITY_END();
}
