/* test_decimal.c - tests of decimal.h: against strtod, which is exact. */
#include "scene/decimal.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sampling/random.h"

#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

/* The same bits as strtod and the same end. */
static void expect_like_strtod(const char *text)
{
    char *want_end;
    double want = strtod(text, &want_end), got = -7.0;
    const char *end = decimal_parse(text, &got);
    TEST_ASSERT_TRUE_MESSAGE(end == want_end, text);
    TEST_ASSERT_EQUAL_MEMORY_MESSAGE(&want, &got, sizeof want, text);
}

static void expect_none(const char *text)
{
    double value = -7.0;
    TEST_ASSERT_NULL_MESSAGE(decimal_parse(text, &value), text);
    TEST_ASSERT_TRUE_MESSAGE(value == -7.0, "the value is left alone");
}

static void all_forms_are_read(void)
{
    static const char *const texts[] = {
        "0",      "12",        "-1.5",    "+3e-7", ".5",
        "2.",     "-.25E+2",   "1e22",    "1e23",  "1e-22",
        "1e-23",  "00012",     "0.00001", "-0",    "0.1",
        "9.99e9", "3.14 tail", "1.5/2",   "7e0\n", "123456789012345678"};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++)
        expect_like_strtod(texts[i]);
}

static void hard_cases_are_rounded_correctly(void)
{
    static const char *const texts[] = {
        "9007199254740993", /* 2^53 + 1: half way, to even */
        "9007199254740992.5",      "9007199254740991",
        "1.7976931348623157e308",  "2.2250738585072011e-308",
        "4.9406564584124654e-324", "0.000000000000000000000000000000123",
        "900719925474099267e4",    "0.30000000000000004441"};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++)
        expect_like_strtod(texts[i]);
}

static void too_large_becomes_infinite_and_too_small_zero(void)
{
    expect_like_strtod("1e999");
    expect_like_strtod("-1e99999999999");
    expect_like_strtod("1e-999");
    expect_like_strtod("0e99999999");
}

static void random_numbers_match(void)
{
    for (uint32_t i = 0; i < 20000; i++) {
        char text[64];
        uint64_t bits = random_mix(i + 1);
        snprintf(text, sizeof text, "%.*e", (int)(bits % 20),
                 ((double)(bits >> 11) - 4e15) * 1e-12);
        expect_like_strtod(text);
        snprintf(text, sizeof text, "%d.%06u", (int)(bits % 2000) - 1000,
                 (unsigned)(bits >> 40) % 1000000u);
        expect_like_strtod(text);
    }
}

static void what_is_no_number_is_refused(void)
{
    static const char *const texts[] = {
        "",    "-",   "+",  ".",   "e5",  "-e1", "abc",  "--1", "+-1", "1e",
        "1e+", "1.e", " 1", "nan", "inf", "NaN", "-inf", "/",   "-.e3"};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++)
        expect_none(texts[i]);
}

/* strtod would read 8. */
static void hexadecimal_is_not_read(void)
{
    double value = -7.0;
    const char *end = decimal_parse("0x1p3", &value);
    TEST_ASSERT_TRUE(value == 0.0);
    TEST_ASSERT_EQUAL_STRING("x1p3", end);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(all_forms_are_read);
    RUN_TEST(hard_cases_are_rounded_correctly);
    RUN_TEST(too_large_becomes_infinite_and_too_small_zero);
    RUN_TEST(random_numbers_match);
    RUN_TEST(what_is_no_number_is_refused);
    RUN_TEST(hexadecimal_is_not_read);
    return UNITY_END();
}
