/* probe.h - what the drivers of all probes share: their arguments and the words
 * of their two files.
 *
 * A driver (assignments/.../hidden/probe_*.c) is the program
 *
 *   probe INPUT OUTPUT GROUP
 *
 * that takes cases from INPUT, asks a module about each and puts what it said
 * into OUTPUT. It judges nothing: an oracle makes the cases and judges the
 * answers, and GROUP tells which of its kinds of cases these are. Both files
 * are nothing but 32-bit little-endian words, unsigned numbers or IEEE singles;
 * the comment on top of each driver says which words make a record.
 *
 *   int main(int argc, char **argv)
 *   {
 *       struct probe p = probe_open("probe_disc", argc, argv);
 *       while (probe_more(&p))
 *           run_case(&p);
 *       return probe_close(&p);
 *   }
 *
 * Words are taken and put in the order of the calls. C leaves open in which
 * order it works out the arguments of a call and the parts of an initialiser:
 * take each value in a declarator or a statement of its own.
 *
 * Errors: whatever is wrong with the arguments or the files is the harness's
 * fault, and never a submission's. It ends the program with one line on stderr
 * and status 2.
 *
 * All functions are static: a driver is one file, and has no symbol but main
 * that a module could meet. */
#ifndef RAYBOOK_DRIVER_PROBE_H
#define RAYBOOK_DRIVER_PROBE_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/box.h"
#include "base/ray.h"
#include "base/rgb.h"
#include "base/vec.h"

/* A driver at work; the names are the arguments', and not owned. */
struct probe {
    const char *program, *input_name, *output_name, *group;
    FILE *input, *output;
};

/* --- The program ---------------------------------------------------------- */

/* Ends the program, with what is wrong about a file or another thing. */
static inline void probe_fail(const struct probe *p, const char *thing,
                              const char *what)
{
    fprintf(stderr, "%s: %s: %s\n", p->program, thing, what);
    exit(2);
}

static inline FILE *probe_open_file(const struct probe *p, const char *name,
                                    const char *mode)
{
    FILE *file = fopen(name, mode);
    if (!file)
        probe_fail(p, name, "cannot be opened");
    return file;
}

/* The driver's name is for its messages; the arguments are main's. */
static inline struct probe probe_open(const char *program, int argc,
                                      char **argv)
{
    if (argc != 4) {
        fprintf(stderr, "usage: %s INPUT OUTPUT GROUP\n", program);
        exit(2);
    }
    struct probe p = {program, argv[1], argv[2], argv[3], NULL, NULL};
    p.input = probe_open_file(&p, p.input_name, "rb");
    p.output = probe_open_file(&p, p.output_name, "wb");
    return p;
}

/* Are the cases of this group? */
static inline bool probe_is(const struct probe *p, const char *group)
{
    return strcmp(p->group, group) == 0;
}

/* Is there another record? Asked between two records only: a file may not end
 * anywhere else. */
static inline bool probe_more(struct probe *p)
{
    int next = getc(p->input);
    if (ferror(p->input))
        probe_fail(p, p->input_name, "cannot be read");
    return next != EOF && ungetc(next, p->input) == next;
}

/* What main returns; all that was put is in OUTPUT then. */
static inline int probe_close(struct probe *p)
{
    if (fclose(p->output) != 0)
        probe_fail(p, p->output_name, "cannot be written");
    fclose(p->input);
    return 0;
}

/* --- Taking --------------------------------------------------------------- */

static inline void take_bytes(struct probe *p, void *bytes, size_t size)
{
    if (fread(bytes, 1, size, p->input) == size)
        return;
    probe_fail(p, p->input_name,
               ferror(p->input)
                   ? "cannot be read"
                   : "ends inside a record; expected whole records of cases");
}

static inline uint32_t take_word(struct probe *p)
{
    unsigned char b[4];
    take_bytes(p, b, sizeof b);
    return (uint32_t)b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 |
           (uint32_t)b[3] << 24;
}

static inline float take_float(struct probe *p)
{
    uint32_t word = take_word(p);
    float value;
    memcpy(&value, &word, sizeof value);
    return value;
}

static inline void take_floats(struct probe *p, float *values, size_t count)
{
    for (size_t i = 0; i < count; i++)
        values[i] = take_float(p);
}

static inline vec2 take_vec2(struct probe *p)
{
    float x = take_float(p), y = take_float(p);
    return vec2_make(x, y);
}

static inline vec3 take_vec3(struct probe *p)
{
    float x = take_float(p), y = take_float(p), z = take_float(p);
    return vec3_make(x, y, z);
}

static inline rgb take_rgb(struct probe *p)
{
    float r = take_float(p), g = take_float(p), b = take_float(p);
    return rgb_make(r, g, b);
}

/* Lower corner, upper corner. */
static inline aabb take_box(struct probe *p)
{
    aabb box;
    box.lower = take_vec3(p);
    box.upper = take_vec3(p);
    return box;
}

/* Origin, direction, t_min, t_max. */
static inline ray take_ray(struct probe *p)
{
    vec3 origin = take_vec3(p), direction = take_vec3(p);
    float t_min = take_float(p), t_max = take_float(p);
    return ray_make(origin, direction, t_min, t_max);
}

/* --- Putting -------------------------------------------------------------- */

static inline void put_word(struct probe *p, uint32_t word)
{
    unsigned char b[4];
    for (int i = 0; i < 4; i++)
        b[i] = (unsigned char)(word >> (8 * i));
    if (fwrite(b, 1, sizeof b, p->output) != sizeof b)
        probe_fail(p, p->output_name, "cannot be written");
}

static inline void put_words(struct probe *p, const uint32_t *words,
                             size_t count)
{
    for (size_t i = 0; i < count; i++)
        put_word(p, words[i]);
}

/* The bits of a single, whatever they are: of a NaN, too. */
static inline uint32_t word_of(float value)
{
    uint32_t word;
    memcpy(&word, &value, sizeof word);
    return word;
}

static inline void put_float(struct probe *p, float value)
{
    put_word(p, word_of(value));
}

static inline void put_vec3(struct probe *p, vec3 v)
{
    put_float(p, v.x);
    put_float(p, v.y);
    put_float(p, v.z);
}

static inline void put_rgb(struct probe *p, rgb c)
{
    put_float(p, c.r);
    put_float(p, c.g);
    put_float(p, c.b);
}

#endif
