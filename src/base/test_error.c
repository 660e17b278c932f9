/* test_error.c - tests of error.h and nearest.h: what messages are made of. */
#include "base/error.h"

#include <string.h>

#include "base/nearest.h"

#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static void storing_a_fault_returns_false(void)
{
    struct error err = {""};
    TEST_ASSERT_FALSE(error_set(&err, "%s: expected %d", "film", 3));
    TEST_ASSERT_EQUAL_STRING("film: expected 3", err.text);
}

static void the_first_fault_wins(void)
{
    struct error err = {""};
    error_set(&err, "first");
    TEST_ASSERT_FALSE(error_set(&err, "second"));
    TEST_ASSERT_EQUAL_STRING("first", err.text);
}

static void a_long_message_is_cut(void)
{
    char text[2 * ERROR_TEXT_SIZE];
    struct error err = {""};
    memset(text, 'x', sizeof text - 1);
    text[sizeof text - 1] = '\0';
    error_set(&err, "%s", text);
    TEST_ASSERT_EQUAL_INT(ERROR_TEXT_SIZE - 1, (int)strlen(err.text));
}

static const char *const names[] = {
    "integrator", "film", "camera", "textures", "light", "lights", "spp", NULL};

static void a_typing_mistake_finds_its_name(void)
{
    TEST_ASSERT_EQUAL_STRING("camera", nearest_name("camara", names));
    TEST_ASSERT_EQUAL_STRING("camera", nearest_name("cmera", names));
    TEST_ASSERT_EQUAL_STRING("camera", nearest_name("cameraa", names));
    TEST_ASSERT_EQUAL_STRING("integrator", nearest_name("intgratr", names));
}

static void the_nearest_of_several_wins(void)
{
    TEST_ASSERT_EQUAL_STRING("light", nearest_name("ligt", names));
    TEST_ASSERT_EQUAL_STRING("lights", nearest_name("lihts", names));
}

static void case_alone_counts_nothing(void)
{
    TEST_ASSERT_EQUAL_STRING("textures", nearest_name("TEXTURES", names));
}

static void something_else_finds_nothing(void)
{
    TEST_ASSERT_NULL(nearest_name("background", names));
    TEST_ASSERT_NULL(nearest_name("x", names));
    TEST_ASSERT_NULL(nearest_name("", names));
}

static void words_of_any_length_are_read(void)
{
    char text[200];
    memset(text, 'f', sizeof text);
    for (size_t length = 60; length < sizeof text; length++) {
        text[length] = '\0';
        TEST_ASSERT_NULL(nearest_name(text, names));
        const char *const long_name[] = {text, "film", NULL};
        TEST_ASSERT_EQUAL_STRING("film", nearest_name("fil", long_name));
        text[length] = 'f';
    }
}

static void an_empty_list_has_no_name(void)
{
    const char *const none[] = {NULL};
    TEST_ASSERT_NULL(nearest_name("film", none));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(storing_a_fault_returns_false);
    RUN_TEST(the_first_fault_wins);
    RUN_TEST(a_long_message_is_cut);
    RUN_TEST(a_typing_mistake_finds_its_name);
    RUN_TEST(the_nearest_of_several_wins);
    RUN_TEST(case_alone_counts_nothing);
    RUN_TEST(something_else_finds_nothing);
    RUN_TEST(words_of_any_length_are_read);
    RUN_TEST(an_empty_list_has_no_name);
    return UNITY_END();
}
