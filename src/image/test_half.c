/* test_half.c - half floats and the sRGB curve: tables and round trips. */
#include "image/half.h"

#include <math.h>
#include <unity.h>

#include "image/png.h"
#include "image/srgb.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static void test_half_by_its_definition(void)
{
    for (int bits = 0; bits < 65536; bits++) {
        int sign = bits >> 15, exponent = bits >> 10 & 31, low = bits & 1023;
        double want = exponent == 0
                          ? low * exp2(-24.0)
                          : (1.0 + low / 1024.0) * exp2(exponent - 15);
        if (exponent == 31)
            continue;
        TEST_ASSERT_TRUE((sign ? -want : want) ==
                         half_to_float((uint16_t)bits));
    }
}

static void test_half_of_known_numbers(void)
{
    TEST_ASSERT_EQUAL_FLOAT(1.0f, half_to_float(0x3c00));
    TEST_ASSERT_EQUAL_FLOAT(-2.0f, half_to_float(0xc000));
    TEST_ASSERT_EQUAL_FLOAT(65504.0f, half_to_float(0x7bff));
    TEST_ASSERT_EQUAL_FLOAT(0x1p-24f, half_to_float(0x0001));
    TEST_ASSERT_TRUE(half_to_float(0x7c00) == INFINITY);
    TEST_ASSERT_TRUE(half_to_float(0xfc00) == -INFINITY);
    TEST_ASSERT_TRUE(isnan(half_to_float(0x7e00)));
    TEST_ASSERT_TRUE(signbit(half_to_float(0x8000)) != 0);
}

/* By IEC 61966-2-1, worked out in decimal to 30 digits. */
static void test_srgb_of_known_codes(void)
{
    TEST_ASSERT_EQUAL_FLOAT(0.0f, srgb_decode(0.0f));
    TEST_ASSERT_FLOAT_WITHIN(1e-10f, 3.0352698e-4f, srgb_decode(1 / 255.0f));
    TEST_ASSERT_FLOAT_WITHIN(1e-9f, 3.0352698e-3f, srgb_decode(10 / 255.0f));
    TEST_ASSERT_FLOAT_WITHIN(1e-9f, 3.3465358e-3f, srgb_decode(11 / 255.0f));
    TEST_ASSERT_FLOAT_WITHIN(1e-7f, 0.2158605f, srgb_decode(128 / 255.0f));
    TEST_ASSERT_FLOAT_WITHIN(1e-7f, 0.5028865f, srgb_decode(188 / 255.0f));
    TEST_ASSERT_EQUAL_FLOAT(1.0f, srgb_decode(1.0f));
}

static void test_srgb_there_and_back(void)
{
    for (int code = 0; code < 256; code++)
        TEST_ASSERT_EQUAL_INT(code,
                              srgb_encode(srgb_decode((float)code / 255.0f)));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_half_by_its_definition);
    RUN_TEST(test_half_of_known_numbers);
    RUN_TEST(test_srgb_of_known_codes);
    RUN_TEST(test_srgb_there_and_back);
    return UNITY_END();
}
