/* test_json.c - tests of json_place.h and json_reader.h: what is read, and
 * what the one message about a fault says. */
#include "scene/json_place.h"

#include <stdio.h>
#include <string.h>

#include "scene/json_reader.h"

#include "unity.h"

static struct json_reader reader;
static struct error fault;

void setUp(void)
{
    fault.text[0] = '\0';
    reader.root = NULL;
}

void tearDown(void)
{
    json_close(&reader);
}

static const cJSON *parse(const char *text)
{
    TEST_ASSERT_TRUE_MESSAGE(json_open_text(&reader, "a.json", text, &fault),
                             text);
    return reader.root;
}

/* The member v of an object whose text is {"v": ...}. */
static const cJSON *member(const char *value)
{
    char text[512];
    snprintf(text, sizeof text, "{\"v\": %s}", value);
    json_close(&reader);
    fault.text[0] = '\0';
    return json_get(parse(text), "v");
}

static void expect_fault(const char *message)
{
    TEST_ASSERT_EQUAL_STRING(message, fault.text);
}

static void expect_fine(void)
{
    TEST_ASSERT_EQUAL_STRING("", fault.text);
    TEST_ASSERT_TRUE(json_fine(&reader));
}

/* Places ------------------------------------------------------------------ */

static void expect_pointer(const char *want, const cJSON *node)
{
    char where[JSON_PLACE_SIZE];
    json_pointer(reader.root, node, where);
    TEST_ASSERT_EQUAL_STRING(want, where);
}

static void pointers_name_keys_and_indices(void)
{
    const cJSON *root = parse("{\"a\": 1, \"objects\": [{}, {\"b\": [7, 8]}]}");
    const cJSON *objects = json_get(root, "objects");
    const cJSON *list = json_get(cJSON_GetArrayItem(objects, 1), "b");
    expect_pointer("", root);
    expect_pointer("/a", json_get(root, "a"));
    expect_pointer("/objects", objects);
    expect_pointer("/objects/0", cJSON_GetArrayItem(objects, 0));
    expect_pointer("/objects/1/b/1", cJSON_GetArrayItem(list, 1));
}

static void pointers_escape_tilde_and_slash(void)
{
    const cJSON *root = parse("{\"a/b~c\": {\"\": 1}}");
    const cJSON *inner = json_get(root, "a/b~c");
    expect_pointer("/a~1b~0c", inner);
    expect_pointer("/a~1b~0c/", json_get(inner, ""));
}

static void a_node_from_elsewhere_has_no_pointer(void)
{
    cJSON *other = cJSON_CreateNumber(1);
    parse("{\"a\": 1}");
    expect_pointer("", other);
    cJSON_Delete(other);
}

/* Deep nesting and long keys: cut, but never beyond the buffer. */
static void long_pointers_are_cut(void)
{
    static char text[4096];
    size_t n = 0;
    for (int i = 0; i < 200; i++)
        n += (size_t)sprintf(text + n, "{\"~/key\":");
    n += (size_t)sprintf(text + n, "1");
    for (int i = 0; i < 200; i++)
        text[n++] = '}';
    const cJSON *node = parse(text);
    while (node->child != NULL)
        node = node->child;
    char where[JSON_PLACE_SIZE];
    memset(where, 'x', sizeof where);
    json_pointer(reader.root, node, where);
    TEST_ASSERT_NOT_NULL(memchr(where, '\0', sizeof where));
}

static void one_long_key_is_cut(void)
{
    static char text[2 * JSON_PLACE_SIZE];
    for (int length = JSON_PLACE_SIZE - 6; length < JSON_PLACE_SIZE + 6;
         length++) {
        sprintf(text, "{\"%0*d/\": {\"b\": [1]}}", length, 0);
        const cJSON *node = parse(text)->child->child->child;
        char where[JSON_PLACE_SIZE];
        memset(where, 'x', sizeof where);
        json_pointer(reader.root, node, where);
        TEST_ASSERT_NOT_NULL(memchr(where, '\0', sizeof where));
        json_close(&reader);
    }
}

static void expect_description(const char *want, const char *json)
{
    char text[JSON_PLACE_SIZE];
    json_describe(member(json), text);
    TEST_ASSERT_EQUAL_STRING(want, text);
}

static void values_are_described_in_words(void)
{
    expect_description("the string \"abc\"", "\"abc\"");
    expect_description("the number 2.5", "2.5");
    expect_description("true", "true");
    expect_description("false", "false");
    expect_description("null", "null");
    expect_description("a list of 3", "[1, 2, 3]");
    expect_description("a list of 0", "[]");
    expect_description("an object", "{\"a\": 1}");
}

static void nothing_is_described_too(void)
{
    char text[JSON_PLACE_SIZE];
    json_describe(NULL, text);
    TEST_ASSERT_EQUAL_STRING("nothing", text);
}

/* Text that is not JSON ---------------------------------------------------- */

static void refuse_text(const char *text, const char *start_of_message)
{
    fault.text[0] = '\0';
    TEST_ASSERT_FALSE(json_open_text(&reader, "a.json", text, &fault));
    TEST_ASSERT_EQUAL_STRING_LEN(start_of_message, fault.text,
                                 strlen(start_of_message));
}

static void the_place_of_a_syntax_fault_is_shown(void)
{
    refuse_text("{\n  \"a\": 1,\n  \"b\": oops\n}", "a.json:3:8: ");
    TEST_ASSERT_NOT_NULL(strstr(fault.text, "\n    \"b\": oops\n"));
    const char *caret = strrchr(fault.text, '\n');
    TEST_ASSERT_EQUAL_STRING("\n         ^", caret);
}

static void a_text_that_ends_early_is_told(void)
{
    refuse_text("{\"a\": 1", "a.json:1:8: the text ends too early");
    refuse_text("{\"a\": [1,\n 2\n", "a.json:2:");
    TEST_ASSERT_NOT_NULL(strstr(fault.text, "the text ends too early"));
    refuse_text("", "a.json:1:1: the text ends too early");
}

static void text_behind_the_document_is_a_fault(void)
{
    refuse_text("{} {}", "a.json:1:4: ");
    refuse_text("{\"a\": 1}}", "a.json:1:9: ");
}

/* The two most common mistakes in files that people write. */
static void a_comma_too_many_is_told_at_its_place(void)
{
    refuse_text("{\"a\": 1,}", "a.json:1:9: not valid JSON from '}' on");
    refuse_text("{\"a\": [1,]}", "a.json:1:10: not valid JSON from ']' on");
}

static void a_key_without_quotes_is_told_at_its_place(void)
{
    refuse_text("{spp: 1}", "a.json:1:2: not valid JSON from 's' on");
    refuse_text("{\"a\": 1,\n  spp: 1}", "a.json:2:3: not valid JSON from 's'");
}

static void bytes_that_cannot_be_shown_are_numbered(void)
{
    refuse_text("{\"a\": \x7f}", "a.json:1:7: unexpected byte 0x7f");
    refuse_text("{\"a\": \xff}", "a.json:1:7: unexpected byte 0xff");
}

static void a_fault_far_to_the_right_is_shown(void)
{
    char text[600];
    sprintf(text, "{\"a\": \"%0400d\", \"b\": oops}", 0);
    refuse_text(text, "a.json:1:416: ");
    TEST_ASSERT_NOT_NULL(strstr(fault.text, "oops"));
}

static void nesting_without_end_is_a_fault(void)
{
    static char text[200001];
    memset(text, '[', sizeof text - 1);
    refuse_text(text, "a.json:1:");
}

/* Values ------------------------------------------------------------------ */

static void absent_keys_give_the_default(void)
{
    vec3 seven = vec3_make(7, 7, 7);
    TEST_ASSERT_TRUE(json_number(&reader, NULL, any_float, 1.5) == 1.5);
    TEST_ASSERT_EQUAL_INT(3, json_integer(&reader, NULL, any_float, 3));
    TEST_ASSERT_TRUE(json_bool(&reader, NULL, true));
    TEST_ASSERT_EQUAL_STRING("x", json_string(&reader, NULL, "x"));
    TEST_ASSERT_EQUAL_FLOAT(7, json_vec3(&reader, NULL, seven).y);
    TEST_ASSERT_EQUAL_FLOAT(2, json_rgb(&reader, NULL, rgb_grey(2)).g);
    TEST_ASSERT_EQUAL_FLOAT(1, json_transform(&reader, NULL).m[2][2]);
    TEST_ASSERT_EQUAL_STRING("", fault.text);
}

static void values_are_read(void)
{
    TEST_ASSERT_EQUAL_FLOAT(-2.5f,
                            json_float(&reader, member("-2.5"), any_float, 0));
    TEST_ASSERT_EQUAL_INT(12,
                          json_integer(&reader, member("12"), above_zero, 0));
    TEST_ASSERT_TRUE(json_bool(&reader, member("true"), false));
    TEST_ASSERT_FALSE(json_bool(&reader, member("false"), true));
    vec3 v = json_vec3(&reader, member("[1, -2, 3e2]"), vec3_make(0, 0, 0));
    TEST_ASSERT_EQUAL_FLOAT(-2, v.y);
    TEST_ASSERT_EQUAL_FLOAT(300, v.z);
    TEST_ASSERT_EQUAL_STRING(
        "a \"b\" \xc3\xa9",
        json_string(&reader, member("\"a \\\"b\\\" \\u00e9\""), ""));
    expect_fine();
}

static void a_wrong_type_says_what_was_expected(void)
{
    json_float(&reader, member("\"3\""), above_zero, 1);
    expect_fault("a.json: /v: found the string \"3\", expected a number above "
                 "0");
    json_bool(&reader, member("1"), false);
    expect_fault("a.json: /v: found the number 1, expected true or false");
    json_string(&reader, member("null"), "");
    expect_fault("a.json: /v: found null, expected a string");
    json_is_list(&reader, member("{}"));
    expect_fault("a.json: /v: found an object, expected a list [ ... ]");
}

static void numbers_out_of_range_are_faults(void)
{
    static const struct json_range few = {1, 4, "a whole number from 1 to 4"};
    TEST_ASSERT_EQUAL_INT(2, json_integer(&reader, member("5"), few, 2));
    expect_fault("a.json: /v: found the number 5, expected a whole number from "
                 "1 to 4");
    TEST_ASSERT_EQUAL_INT(2, json_integer(&reader, member("1.5"), few, 2));
    TEST_ASSERT_FALSE(json_fine(&reader));
    json_float(&reader, member("0"), above_zero, 1);
    TEST_ASSERT_FALSE(json_fine(&reader));
    json_float(&reader, member("1e39"), any_float, 1);
    TEST_ASSERT_FALSE_MESSAGE(json_fine(&reader), "not finite as a float");
    json_float(&reader, member("-1e999"), any_float, 1);
    TEST_ASSERT_FALSE_MESSAGE(json_fine(&reader), "not finite");
}

static void lists_have_their_length_and_numbers(void)
{
    vec3 zero = vec3_make(0, 0, 0);
    json_vec3(&reader, member("[1, 2]"), zero);
    expect_fault("a.json: /v: found a list of 2, expected a list of 3 numbers");
    json_vec3(&reader, member("[1, 2, \"3\"]"), zero);
    expect_fault("a.json: /v/2: found the string \"3\", expected a number");
    json_vec3(&reader, member("7"), zero);
    expect_fault("a.json: /v: found the number 7, expected a list of 3 "
                 "numbers");
    json_rgb(&reader, member("[1, -0.5, 0]"), rgb_grey(0));
    expect_fault("a.json: /v/1: found the number -0.5, expected a number, 0 or "
                 "more");
}

static void transforms_must_be_invertible(void)
{
    json_transform(&reader, member("[1,0,0,0, 0,1,0,0, 0,0,1,5, 0,0,0,1]"));
    expect_fine();
    json_transform(&reader, member("[1,0,0,0, 0,1,0,0, 0,0,0,5, 0,0,0,1]"));
    expect_fault("a.json: /v: the transform cannot be inverted or its last row "
                 "is not 0, 0, 0, 1");
    json_transform(&reader, member("[1,2,3]"));
    expect_fault("a.json: /v: found a list of 3, expected a list of 16 "
                 "numbers, row by row");
}

/* Keys and names ---------------------------------------------------------- */

static const char *const known[] = {"type", "spp", "max_depth", NULL};

static void unknown_keys_are_faults(void)
{
    TEST_ASSERT_TRUE(json_keys(&reader, member("{\"spp\": 1}"), known));
    TEST_ASSERT_FALSE(json_keys(&reader, member("{\"sp\": 1}"), known));
    expect_fault("a.json: /v: unknown key \"sp\": did you mean \"spp\"?");
    json_keys(&reader, member("{\"background\": 1}"), known);
    expect_fault("a.json: /v: unknown key \"background\", expected one of "
                 "\"type\", \"spp\", \"max_depth\"");
    json_keys(&reader, member("[]"), known);
    expect_fault("a.json: /v: found a list of 0, expected an object { ... }");
}

static void keys_are_case_sensitive(void)
{
    json_keys(&reader, member("{\"SPP\": 1}"), known);
    expect_fault("a.json: /v: unknown key \"SPP\": did you mean \"spp\"?");
}

static void a_key_twice_is_a_fault(void)
{
    json_keys(&reader, member("{\"spp\": 1, \"type\": 2, \"spp\": 3}"), known);
    expect_fault("a.json: /v: the key \"spp\" is there twice");
}

static void required_keys_are_required(void)
{
    TEST_ASSERT_NULL(json_require(&reader, member("{}"), "path"));
    expect_fault("a.json: /v: the key \"path\" is missing");
}

static void names_are_looked_up(void)
{
    TEST_ASSERT_EQUAL_INT(2,
                          json_name(&reader, member("\"max_depth\""), known));
    expect_fine();
    TEST_ASSERT_EQUAL_INT(0, json_name(&reader, member("\"tipe\""), known));
    expect_fault("a.json: /v: unknown name \"tipe\": did you mean \"type\"?");
}

static void the_first_fault_is_told(void)
{
    const cJSON *root = parse("{\"a\": \"x\", \"b\": \"y\"}");
    json_float(&reader, json_get(root, "a"), any_float, 0);
    json_float(&reader, json_get(root, "b"), any_float, 0);
    expect_fault("a.json: /a: found the string \"x\", expected a number");
}

static void a_fault_of_the_root_names_the_whole_file(void)
{
    json_fault(&reader, parse("[]"), "no good");
    expect_fault("a.json: the whole file: no good");
}

int main(void)
{
    UNITY_BEGIN();
    reader.err = &fault;
    RUN_TEST(pointers_name_keys_and_indices);
    RUN_TEST(pointers_escape_tilde_and_slash);
    RUN_TEST(a_node_from_elsewhere_has_no_pointer);
    RUN_TEST(long_pointers_are_cut);
    RUN_TEST(one_long_key_is_cut);
    RUN_TEST(values_are_described_in_words);
    RUN_TEST(nothing_is_described_too);
    RUN_TEST(the_place_of_a_syntax_fault_is_shown);
    RUN_TEST(a_text_that_ends_early_is_told);
    RUN_TEST(text_behind_the_document_is_a_fault);
    RUN_TEST(a_comma_too_many_is_told_at_its_place);
    RUN_TEST(a_key_without_quotes_is_told_at_its_place);
    RUN_TEST(bytes_that_cannot_be_shown_are_numbered);
    RUN_TEST(a_fault_far_to_the_right_is_shown);
    RUN_TEST(nesting_without_end_is_a_fault);
    RUN_TEST(absent_keys_give_the_default);
    RUN_TEST(values_are_read);
    RUN_TEST(a_wrong_type_says_what_was_expected);
    RUN_TEST(numbers_out_of_range_are_faults);
    RUN_TEST(lists_have_their_length_and_numbers);
    RUN_TEST(transforms_must_be_invertible);
    RUN_TEST(unknown_keys_are_faults);
    RUN_TEST(keys_are_case_sensitive);
    RUN_TEST(a_key_twice_is_a_fault);
    RUN_TEST(required_keys_are_required);
    RUN_TEST(names_are_looked_up);
    RUN_TEST(the_first_fault_is_told);
    RUN_TEST(a_fault_of_the_root_names_the_whole_file);
    return UNITY_END();
}
