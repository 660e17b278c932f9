/* test_obj_reader.c - tests of obj_reader.h: what is read, and the place that
 * a fault's message names. */
#define _POSIX_C_SOURCE 200809L

#include "scene/obj_reader.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "unity.h"

static char path[] = "/tmp/raybook-obj-XXXXXX";
static struct mesh mesh;
static struct error fault;

void setUp(void)
{
    fault.text[0] = '\0';
    memset(&mesh, 0, sizeof mesh);
}

void tearDown(void)
{
    mesh_free(&mesh);
}

static void write_bytes(const char *bytes, size_t size)
{
    FILE *f = fopen(path, "wb");
    TEST_ASSERT_NOT_NULL(f);
    TEST_ASSERT_TRUE(fwrite(bytes, 1, size, f) == size);
    fclose(f);
}

static void read_text(const char *text)
{
    write_bytes(text, strlen(text));
    mesh_free(&mesh);
    fault.text[0] = '\0';
    if (!obj_read(path, &mesh, &fault))
        TEST_FAIL_MESSAGE(fault.text);
}

/* The message must be "path" + want; nothing is handed out. */
static void refuse_bytes(const char *bytes, size_t size, const char *want)
{
    static const struct mesh none;
    write_bytes(bytes, size);
    fault.text[0] = '\0';
    memset(&mesh, 7, sizeof mesh);
    bool fine = obj_read(path, &mesh, &fault);
    int unlike_none = memcmp(&mesh, &none, sizeof mesh);
    memset(&mesh, 0, sizeof mesh);
    TEST_ASSERT_FALSE_MESSAGE(fine, bytes);
    TEST_ASSERT_EQUAL_INT_MESSAGE(0, unlike_none, "*out is all zero");
    TEST_ASSERT_EQUAL_STRING_LEN(path, fault.text, strlen(path));
    TEST_ASSERT_EQUAL_STRING(want, fault.text + strlen(path));
}

static void refuse(const char *text, const char *want)
{
    refuse_bytes(text, strlen(text), want);
}

static void expect_size(uint32_t vertices, uint32_t triangles)
{
    TEST_ASSERT_EQUAL_UINT32(vertices, mesh.vertex_count);
    TEST_ASSERT_EQUAL_UINT32(triangles, mesh.triangle_count);
    for (uint32_t i = 0; i < 3 * triangles; i++)
        TEST_ASSERT_TRUE(mesh.indices[i] < vertices);
}

static void expect_corner(uint32_t triangle, int corner, float x, float y)
{
    vec3 p[3];
    mesh_corners(&mesh, triangle, p);
    TEST_ASSERT_EQUAL_FLOAT(x, p[corner].x);
    TEST_ASSERT_EQUAL_FLOAT(y, p[corner].y);
}

#define SQUARE "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"

/* What is read ------------------------------------------------------------ */

static void a_triangle_is_read(void)
{
    read_text(SQUARE "f 1 2 3\n");
    expect_size(3, 1);
    expect_corner(0, 0, 0, 0);
    expect_corner(0, 1, 1, 0);
    expect_corner(0, 2, 1, 1);
    TEST_ASSERT_NULL(mesh.normals);
    TEST_ASSERT_NULL(mesh.uvs);
}

static void a_quad_becomes_two_triangles(void)
{
    read_text(SQUARE "f 1 2 3 4\n");
    expect_size(4, 2);
    expect_corner(1, 0, 0, 0);
    expect_corner(1, 1, 1, 1);
    expect_corner(1, 2, 0, 1);
}

static void a_polygon_becomes_a_fan(void)
{
    read_text("v 0 0 0\nv 1 0 0\nv 2 1 0\nv 2 2 0\nv 1 3 0\nv 0 2 0\n"
              "f 1 2 3 4 5 6\n");
    expect_size(6, 4);
    for (uint32_t i = 0; i < 4; i++)
        expect_corner(i, 0, 0, 0);
    expect_corner(3, 1, 1, 3);
    expect_corner(3, 2, 0, 2);
}

static void negative_indices_count_back(void)
{
    read_text(SQUARE "f -4 -3 -2\nv 5 5 0\nf -1 1 -4\n");
    expect_size(4, 2);
    expect_corner(0, 0, 0, 0);
    expect_corner(0, 2, 1, 1);
    expect_corner(1, 0, 5, 5);
    expect_corner(1, 2, 1, 0);
}

static void all_forms_of_a_corner_are_read(void)
{
    static const char *const faces[] = {
        "f 1 2 3\n",          "f 1/1 2/2 3/1\n",
        "f 1//1 2//1 3//1\n", "f 1/1/1 2/2/1 3/1/1\n",
        "f 1/ 2/ 3/\n",       "f 1// 2// 3//\n",
        "f 1/2/ 2/1/ 3/1/\n", "f -4/-1/-1 2/1/1 3/2/1\n"};
    static const bool uv[] = {0, 1, 0, 1, 0, 0, 1, 1};
    static const bool normal[] = {0, 0, 1, 1, 0, 0, 0, 1};
    for (int i = 0; i < 8; i++) {
        char text[200];
        sprintf(text, SQUARE "vt 0 0\nvt 1 0.25\nvn 0 0 1\n%s", faces[i]);
        read_text(text);
        expect_size(3, 1);
        TEST_ASSERT_EQUAL_INT_MESSAGE(uv[i], mesh.uvs != NULL, faces[i]);
        TEST_ASSERT_EQUAL_INT_MESSAGE(normal[i], mesh.normals != NULL,
                                      faces[i]);
    }
}

static void texture_coordinates_are_flipped_once(void)
{
    read_text(SQUARE "vt 0.25 0.125\nvt 1\nvt 0 0 0.5\nf 1/1 2/2 3/3\n");
    TEST_ASSERT_EQUAL_FLOAT(0.25f, mesh.uvs[mesh.indices[0]].x);
    TEST_ASSERT_EQUAL_FLOAT(0.875f, mesh.uvs[mesh.indices[0]].y);
    TEST_ASSERT_EQUAL_FLOAT(1, mesh.uvs[mesh.indices[1]].x);
    TEST_ASSERT_EQUAL_FLOAT(1, mesh.uvs[mesh.indices[1]].y);
    TEST_ASSERT_EQUAL_FLOAT(1, mesh.uvs[mesh.indices[2]].y);
}

static void one_corner_without_drops_the_attribute(void)
{
    read_text(SQUARE
              "vt 0 0\nvn 0 0 1\nf 1/1/1 2/1/1 3/1/1\nf 1//1 3//1 4//1\n");
    TEST_ASSERT_NULL(mesh.uvs);
    TEST_ASSERT_NOT_NULL(mesh.normals);
}

static void a_seam_becomes_two_vertices(void)
{
    read_text(SQUARE "vt 0 0\nvt 1 0\nf 1/1 2/1 3/1\nf 1/2 3/1 4/1\n");
    expect_size(5, 2);
    expect_corner(0, 0, 0, 0);
    expect_corner(1, 0, 0, 0);
    TEST_ASSERT_EQUAL_FLOAT(0, mesh.uvs[mesh.indices[0]].x);
    TEST_ASSERT_EQUAL_FLOAT(1, mesh.uvs[mesh.indices[3]].x);
    TEST_ASSERT_EQUAL_UINT32(mesh.indices[2], mesh.indices[4]);
}

static void normals_come_as_in_the_file(void)
{
    read_text(SQUARE "vn 0 0 2\nvn 0 0 0\nf 1//1 2//2 3//1\n");
    TEST_ASSERT_EQUAL_FLOAT(2, mesh.normals[mesh.indices[0]].z);
    TEST_ASSERT_EQUAL_FLOAT(0, mesh.normals[mesh.indices[1]].z);
}

static void lines_go_on_behind_a_backslash(void)
{
    read_text("v 0 0 \\\n0\nv 1 0 0\nv \\\r\n1 1 0\nf 1 \\\n2 \\\n 3\n");
    expect_size(3, 1);
    expect_corner(0, 2, 1, 1);
}

static void line_ends_of_all_systems_are_read(void)
{
    read_text("v 0 0 0\r\nv 1 0 0\r\nv 1 1 0\r\nf 1 2 3\r\n");
    expect_size(3, 1);
    read_text(SQUARE "f 1 2 3");
    expect_size(3, 1);
}

static void comments_blanks_and_other_keywords_are_passed_over(void)
{
    read_text("# a comment\n\n   \t\nmtllib a.mtl\no thing\ng a b\ns off\n"
              "\tv\t0 0  0 # here\nv 1 0 0\nv 1 1 0\nusemtl red\nvp 1 2\n"
              "l 1 2\np 1\n  f  1\t2 3 # there\n# f 1 2 9\n");
    expect_size(3, 1);
}

static void further_numbers_of_a_vertex_are_dropped(void)
{
    read_text("v 0 0 0 1\nv 1 0 0 0.5 0.5 0.5\nv 1 1 0\nf 1 2 3\n");
    expect_size(3, 1);
    expect_corner(0, 1, 1, 0);
}

static void unused_vertices_are_left_out(void)
{
    read_text("v 9 9 9\n" SQUARE "f 2 3 4\n");
    expect_size(3, 1);
    expect_corner(0, 0, 0, 0);
}

static void triangles_without_area_are_kept(void)
{
    read_text(SQUARE "f 1 1 1\nf 1 2 1\n");
    expect_size(2, 2);
}

/* Enough for the tables to grow several times. */
static void many_faces_are_read(void)
{
    enum { COUNT = 20000 };
    char *text = malloc(COUNT * 48), *at = text;
    for (int i = 0; i < COUNT; i++)
        at += sprintf(at, "v %d %d.5 0\n", i, i % 7);
    for (int i = 0; i + 2 < COUNT; i++)
        at += sprintf(at, "f %d %d %d\n", i + 1, i + 2, i + 3);
    read_text(text);
    free(text);
    expect_size(COUNT, COUNT - 2);
    expect_corner(12345, 2, 12347, 12347 % 7 + 0.5f);
}

/* Faults ------------------------------------------------------------------ */

static void a_missing_file_is_a_fault(void)
{
    TEST_ASSERT_FALSE(obj_read("/no/such.obj", &mesh, &fault));
    TEST_ASSERT_EQUAL_STRING(
        "/no/such.obj: cannot read: No such file or directory", fault.text);
}

static void a_folder_is_a_fault(void)
{
    TEST_ASSERT_FALSE(obj_read("/tmp", &mesh, &fault));
    TEST_ASSERT_EQUAL_STRING_LEN("/tmp: cannot read: it is a folder",
                                 fault.text, 33);
}

static void a_file_without_faces_is_a_fault(void)
{
    refuse("", ": expected a mesh, found no face (f line)");
    refuse(SQUARE, ": expected a mesh, found no face (f line)");
}

static void indices_out_of_range_are_faults(void)
{
    refuse(SQUARE "f 1 2 5\n", ":5:7: vertex index 5 is out of range: the "
                               "file has 4 vertices so far");
    refuse(SQUARE "f 1 2 -5\n", ":5:7: vertex index -5 is out of range: the "
                                "file has 4 vertices so far");
    refuse(SQUARE "f 0 1 2\n", ":5:3: vertex index 0: indices start at 1");
    refuse(SQUARE "f 1/1 2 3\n", ":5:5: texture coordinate index 1 is out of "
                                 "range: the file has 0 texture coordinates so "
                                 "far");
    refuse(SQUARE "f 1//2 2 3\n", ":5:6: normal index 2 is out of range: the "
                                  "file has 0 normals so far");
    refuse(SQUARE "f 99999999999999999999999 1 2\n",
           ":5:3: vertex index 999999999999999999 is out of range: the file "
           "has 4 vertices so far");
}

static void indices_may_not_look_ahead(void)
{
    refuse("v 0 0 0\nv 1 0 0\nf 1 2 3\nv 1 1 0\n",
           ":3:7: vertex index 3 is out of range: the file has 2 vertices so "
           "far");
}

static void malformed_corners_are_faults(void)
{
    refuse(SQUARE "f 1 2 x\n", ":5:7: expected a vertex index, found \"x\"");
    refuse(SQUARE "f 1 2 3.5\n",
           ":5:8: expected the end of the corner, found \".5\"");
    refuse(SQUARE "vt 0 0\nvn 0 0 1\nf 1/1/1/1 2 3\n",
           ":7:8: expected the end of the corner, found \"/1\"");
    refuse(SQUARE "f /1 2 3\n", ":5:3: expected a vertex index, found \"/1\"");
}

static void faces_with_too_few_corners_are_faults(void)
{
    refuse(SQUARE "f 1 2\n",
           ":5:6: a face needs at least 3 corners, this one has 2");
    refuse(SQUARE "f\n",
           ":5:2: a face needs at least 3 corners, this one has 0");
}

static void malformed_numbers_are_faults(void)
{
    refuse("v 0 x 0\n",
           ":1:5: expected a coordinate, a finite number, found \"x\"");
    refuse("v 0 0\n", ":1:6: expected a coordinate, a finite number, found "
                      "the end of the line");
    refuse("v 0 0 nan\n",
           ":1:7: expected a coordinate, a finite number, found \"nan\"");
    refuse("v 0 0 inf\n",
           ":1:7: expected a coordinate, a finite number, found \"inf\"");
    refuse("v 1e39 0 0\n",
           ":1:3: a coordinate is too large for a float: \"1e39\"");
    refuse("v 0 0 0 red\n", ":1:9: expected a number, a finite number, found "
                            "\"red\"");
    refuse("v 0,5 0 0\n",
           ":1:3: expected a coordinate, a finite number, found \"0,5\"");
    refuse("vt\n", ":1:3: expected a texture coordinate, a finite number, "
                   "found the end of the line");
}

static void places_count_continued_lines(void)
{
    refuse("v 0 0 \\\n   x\n",
           ":2:4: expected a coordinate, a finite number, found \"x\"");
}

static void a_line_without_a_keyword_is_a_fault(void)
{
    refuse("# fine\n0 0 0\n",
           ":2:1: expected a keyword such as v or f, found \"0\"");
    refuse("{\"json\": 1}\n",
           ":1:1: expected a keyword such as v or f, found \"{\"json\":\"");
}

static void bytes_that_are_no_text_are_faults(void)
{
    refuse_bytes("v 0 0 0\nv \0 1\n", 14,
                 ":2:3: found a byte of value 0, expected text (UTF-8)");
    refuse("\x89PNG\r\n",
           ":1:1: expected a keyword such as v or f, found \"?PNG\"");
}

int main(void)
{
    int descriptor = mkstemp(path);
    if (descriptor < 0)
        return 1;
    close(descriptor);
    UNITY_BEGIN();
    RUN_TEST(a_triangle_is_read);
    RUN_TEST(a_quad_becomes_two_triangles);
    RUN_TEST(a_polygon_becomes_a_fan);
    RUN_TEST(negative_indices_count_back);
    RUN_TEST(all_forms_of_a_corner_are_read);
    RUN_TEST(texture_coordinates_are_flipped_once);
    RUN_TEST(one_corner_without_drops_the_attribute);
    RUN_TEST(a_seam_becomes_two_vertices);
    RUN_TEST(normals_come_as_in_the_file);
    RUN_TEST(lines_go_on_behind_a_backslash);
    RUN_TEST(line_ends_of_all_systems_are_read);
    RUN_TEST(comments_blanks_and_other_keywords_are_passed_over);
    RUN_TEST(further_numbers_of_a_vertex_are_dropped);
    RUN_TEST(unused_vertices_are_left_out);
    RUN_TEST(triangles_without_area_are_kept);
    RUN_TEST(many_faces_are_read);
    RUN_TEST(a_missing_file_is_a_fault);
    RUN_TEST(a_folder_is_a_fault);
    RUN_TEST(a_file_without_faces_is_a_fault);
    RUN_TEST(indices_out_of_range_are_faults);
    RUN_TEST(indices_may_not_look_ahead);
    RUN_TEST(malformed_corners_are_faults);
    RUN_TEST(faces_with_too_few_corners_are_faults);
    RUN_TEST(malformed_numbers_are_faults);
    RUN_TEST(places_count_continued_lines);
    RUN_TEST(a_line_without_a_keyword_is_a_fault);
    RUN_TEST(bytes_that_are_no_text_are_faults);
    unlink(path);
    return UNITY_END();
}
