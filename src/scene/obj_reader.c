/* obj_reader.c - see obj_reader.h.
 *
 * One pass over the text of the file, which is held in memory with a zero
 * byte behind it. "Parse" functions start at the cursor, move it behind what
 * they took, and return false after they have reported a fault. */
#include "scene/obj_reader.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "scene/corner_set.h"
#include "scene/decimal.h"
#include "scene/text_file.h"

struct parser {
    const char *path;
    const char *cursor, *line_start;
    unsigned long line;
    struct error *err;
    vec3 *positions, *normals;
    vec2 *uvs;
    size_t position_count, position_capacity;
    size_t normal_count, normal_capacity;
    size_t uv_count, uv_capacity;
    struct corner_set corners;
    uint32_t *indices;
    size_t index_count, index_capacity;
    bool lacks_uv, lacks_normal; /* some corner came without */
};

//> obj_reader.faults: Tell where a file is wrong
/* Faults ------------------------------------------------------------------ */

/* Reports a fault at a place in the current line. */
static bool fail(struct parser *p, const char *at, const char *format, ...)
{
    char what[256];
    va_list args;
    va_start(args, format);
    vsnprintf(what, sizeof what, format, args);
    va_end(args);
    return error_set(p->err, "%s:%lu:%lu: %s", p->path, p->line,
                     (unsigned long)(at - p->line_start) + 1, what);
}

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

static bool is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

static bool ends_word(char c)
{
    return is_blank(c) || c == '\n' || c == '\0' || c == '#' || c == '\\';
}

struct quoted {
    char text[32];
};

/* The word at a place, ready to be shown: shortened, and with ? for what a
 * terminal might not print. */
static struct quoted quote(const char *at)
{
    struct quoted q = {"the end of the line"};
    size_t n = 0;
    if (*at == '\n' || *at == '\0' || *at == '#')
        return q;
    q.text[n++] = '"';
    for (; n < sizeof q.text - 2 && (n == 1 || !ends_word(*at)); at++)
        q.text[n++] = *at > ' ' && *at <= '~' ? *at : '?';
    q.text[n++] = '"';
    q.text[n] = '\0';
    return q;
}
//< obj_reader.faults

//> obj_reader.words: Find the next word
/* Lines and words --------------------------------------------------------- */

static void start_next_line(struct parser *p)
{
    if (*p->cursor == '\n')
        p->cursor++;
    p->line_start = p->cursor;
    p->line++;
}

/* If the line goes on in the next one, moves there. */
static bool skip_continuation(struct parser *p)
{
    const char *c = p->cursor;
    if (*c != '\\')
        return false;
    c += c[1] == '\r' ? 2 : 1;
    if (*c != '\n')
        return false;
    p->cursor = c;
    start_next_line(p);
    return true;
}

static void skip_blanks(struct parser *p)
{
    while (is_blank(*p->cursor) || skip_continuation(p))
        if (is_blank(*p->cursor))
            p->cursor++;
}

/* Moves to the next word; false at the end of the line. */
static bool find_word(struct parser *p)
{
    skip_blanks(p);
    return *p->cursor != '\n' && *p->cursor != '\0' && *p->cursor != '#';
}

static void skip_comment(struct parser *p)
{
    p->cursor += strcspn(p->cursor, "\n");
}

static void skip_rest_of_line(struct parser *p)
{
    while (find_word(p))
        p->cursor++;
    skip_comment(p);
}
//< obj_reader.words

//> obj_reader.numbers: Read numbers
/* Numbers ----------------------------------------------------------------- */

/* One finite number. what says which, for the message. */
static bool parse_number(struct parser *p, const char *what, float *out)
{
    double value;
    skip_blanks(p);
    const char *end = decimal_parse(p->cursor, &value);
    if (end == NULL || !ends_word(*end))
        return fail(p, p->cursor, "expected %s, a finite number, found %s",
                    what, quote(p->cursor).text);
    *out = (float)value;
    if (!isfinite(*out))
        return fail(p, p->cursor, "%s is too large for a float: %s", what,
                    quote(p->cursor).text);
    p->cursor = end;
    return true;
}

static bool parse_vec3(struct parser *p, const char *what, vec3 *out)
{
    return parse_number(p, what, &out->x) && parse_number(p, what, &out->y) &&
           parse_number(p, what, &out->z);
}

/* Checks and drops what may follow the numbers that are used. */
static bool parse_extra_numbers(struct parser *p)
{
    float unused;
    while (find_word(p))
        if (!parse_number(p, "a number", &unused))
            return false;
    return true;
}
//< obj_reader.numbers

//> obj_reader.vertices: Read positions, normals and texture coordinates
/* Vertices ---------------------------------------------------------------- */

/* block with room for one more element than count; the pointer it returns
 * replaces block. */
static void *grow(void *block, size_t count, size_t *capacity, size_t size)
{
    if (count < *capacity)
        return block;
    *capacity = 2 * *capacity + 64;
    return mem_resize(block, *capacity, size);
}

static bool parse_position(struct parser *p)
{
    vec3 v;
    if (!parse_vec3(p, "a coordinate", &v) || !parse_extra_numbers(p))
        return false;
    p->positions = grow(p->positions, p->position_count, &p->position_capacity,
                        sizeof *p->positions);
    p->positions[p->position_count++] = v;
    return true;
}

static bool parse_normal(struct parser *p)
{
    vec3 n;
    if (!parse_vec3(p, "a component of the normal", &n) ||
        !parse_extra_numbers(p))
        return false;
    p->normals = grow(p->normals, p->normal_count, &p->normal_capacity,
                      sizeof *p->normals);
    p->normals[p->normal_count++] = n;
    return true;
}

static bool parse_uv(struct parser *p)
{
    vec2 uv = {0, 0};
    if (!parse_number(p, "a texture coordinate", &uv.x) ||
        (find_word(p) && !parse_number(p, "a texture coordinate", &uv.y)) ||
        !parse_extra_numbers(p))
        return false;
    p->uvs = grow(p->uvs, p->uv_count, &p->uv_capacity, sizeof *p->uvs);
    p->uvs[p->uv_count++] = vec2_make(uv.x, 1.0f - uv.y);
    return true;
}
//< obj_reader.vertices

//> obj_reader.corners: Read the corners of a face
/* Corners ----------------------------------------------------------------- */

/* A whole number stops growing here: out of any mesh's range. */
#define LARGEST_INDEX INT64_C(100000000000000000)

/* Takes "12" or "-3" at *at and moves *at behind it; false if there is no
 * whole number. */
static bool take_index(const char **at, int64_t *value)
{
    const char *c = *at;
    bool negative = *c == '-';
    c += negative ? 1 : 0;
    if (!is_digit(*c))
        return false;
    int64_t v = 0;
    for (; is_digit(*c); c++)
        v = v < LARGEST_INDEX ? 10 * v + (*c - '0') : v;
    *value = negative ? -v : v;
    *at = c;
    return true;
}

/* What an index may name, and how messages call it. */
struct index_kind {
    const char *one, *many;
    size_t count;
};

static const char OUT_OF_RANGE[] =
    "%s index %lld is out of range: the file has %zu %s so far";

/* One index as the file has it; out counts from 0. */
static bool parse_index(struct parser *p, struct index_kind kind, uint32_t *out)
{
    const char *start = p->cursor;
    int64_t value;
    if (!take_index(&p->cursor, &value))
        return fail(p, start, "expected a %s index, found %s", kind.one,
                    quote(start).text);
    if (value == 0)
        return fail(p, start, "%s index 0: indices start at 1", kind.one);
    int64_t count = (int64_t)kind.count;
    if (value > count || value < -count)
        return fail(p, start, OUT_OF_RANGE, kind.one, (long long)value,
                    kind.count, kind.many);
    *out = (uint32_t)(value > 0 ? value - 1 : count + value);
    return true;
}

/* Some programs write 1/2/ or 1// where there is no normal. */
static bool parse_index_or_nothing(struct parser *p, struct index_kind kind,
                                   uint32_t *out)
{
    bool nothing = *p->cursor == '/' || ends_word(*p->cursor);
    return nothing || parse_index(p, kind, out);
}

/* The optional "/vt", "/vt/vn" or "//vn" of a corner. */
static bool parse_corner_rest(struct parser *p, struct corner *c)
{
    struct index_kind uv = {"texture coordinate", "texture coordinates",
                            p->uv_count};
    struct index_kind normal = {"normal", "normals", p->normal_count};
    if (*p->cursor != '/')
        return true;
    p->cursor++;
    if (!parse_index_or_nothing(p, uv, &c->uv))
        return false;
    if (*p->cursor != '/')
        return true;
    p->cursor++;
    return parse_index_or_nothing(p, normal, &c->normal);
}

/* One corner of a face; out is its vertex of the mesh. */
static bool parse_corner(struct parser *p, uint32_t *out)
{
    struct index_kind position = {"vertex", "vertices", p->position_count};
    struct corner c = {NO_INDEX, NO_INDEX, NO_INDEX};
    if (!parse_index(p, position, &c.position) || !parse_corner_rest(p, &c))
        return false;
    if (!ends_word(*p->cursor))
        return fail(p, p->cursor, "expected the end of the corner, found %s",
                    quote(p->cursor).text);
    p->lacks_uv = p->lacks_uv || c.uv == NO_INDEX;
    p->lacks_normal = p->lacks_normal || c.normal == NO_INDEX;
    *out = corner_set_find(&p->corners, c);
    return true;
}
//< obj_reader.corners

//> obj_reader.faces: Cut a face into triangles
/* Faces ------------------------------------------------------------------- */

static void add_index(struct parser *p, uint32_t vertex)
{
    p->indices = grow(p->indices, p->index_count, &p->index_capacity,
                      sizeof *p->indices);
    p->indices[p->index_count++] = vertex;
}

static void add_triangle(struct parser *p, const uint32_t vertices[3])
{
    for (int i = 0; i < 3; i++)
        add_index(p, vertices[i]);
}

/* All corners of a face. The fan keeps its first corner and the latest. */
static bool parse_face(struct parser *p)
{
    uint32_t fan[3];
    unsigned count = 0;
    for (; find_word(p); count++) {
        if (!parse_corner(p, &fan[count < 2 ? count : 2]))
            return false;
        if (count >= 2) {
            add_triangle(p, fan);
            fan[1] = fan[2];
        }
    }
    if (count < 3)
        return fail(p, p->cursor,
                    "a face needs at least 3 corners, this one has %u", count);
    return true;
}
//< obj_reader.faces

//> obj_reader.file: Read line by line
/* The file ---------------------------------------------------------------- */

/* Is this the keyword at the cursor? Then moves behind it. */
static bool take_keyword(struct parser *p, const char *keyword)
{
    size_t length = strlen(keyword);
    if (strncmp(p->cursor, keyword, length) != 0 ||
        !ends_word(p->cursor[length]))
        return false;
    p->cursor += length;
    return true;
}

static bool parse_line(struct parser *p)
{
    if (!find_word(p))
        return true;
    if (take_keyword(p, "v"))
        return parse_position(p);
    if (take_keyword(p, "vt"))
        return parse_uv(p);
    if (take_keyword(p, "vn"))
        return parse_normal(p);
    if (take_keyword(p, "f"))
        return parse_face(p);
    if (!is_letter(*p->cursor))
        return fail(p, p->cursor, "expected a keyword such as v or f, found %s",
                    quote(p->cursor).text);
    skip_rest_of_line(p);
    return true;
}

static bool parse_text(struct parser *p, const char *text)
{
    p->cursor = p->line_start = text;
    for (p->line = 1; *p->cursor != '\0'; start_next_line(p)) {
        if (!parse_line(p))
            return false;
        skip_comment(p);
    }
    if (p->index_count == 0)
        return error_set(p->err, "%s: expected a mesh, found no face (f line)",
                         p->path);
    return true;
}
//< obj_reader.file

//> obj_reader.gather: Make the mesh
/* The mesh's arrays from the file's, by the distinct corners. */
static void gather(const struct parser *p, struct mesh *out)
{
    size_t count = p->corners.count;
    out->vertex_count = (uint32_t)count;
    out->triangle_count = (uint32_t)(p->index_count / 3);
    out->positions = mem_alloc(count, sizeof *out->positions);
    if (!p->lacks_uv)
        out->uvs = mem_alloc(count, sizeof *out->uvs);
    if (!p->lacks_normal)
        out->normals = mem_alloc(count, sizeof *out->normals);
    for (size_t i = 0; i < count; i++) {
        struct corner c = p->corners.items[i];
        out->positions[i] = p->positions[c.position];
        if (out->uvs != NULL)
            out->uvs[i] = p->uvs[c.uv];
        if (out->normals != NULL)
            out->normals[i] = p->normals[c.normal];
    }
}

static void release(struct parser *p)
{
    mem_free(p->positions);
    mem_free(p->normals);
    mem_free(p->uvs);
    corner_set_free(&p->corners);
    mem_free(p->indices);
}

bool obj_read(const char *path, struct mesh *out, struct error *err)
{
    struct parser p = {.path = path, .err = err};
    memset(out, 0, sizeof *out);
    char *text = text_file_read(path, err);
    if (text == NULL)
        return false;
    bool ok = parse_text(&p, text);
    mem_free(text);
    if (ok) {
        gather(&p, out);
        out->indices = p.indices;
        p.indices = NULL;
    }
    release(&p);
    return ok;
}
//< obj_reader.gather
