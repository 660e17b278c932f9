/* options.c - see options.h. */
#include "program/options.h"

#include <errno.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/nearest.h"
#include "program/option_values.h"
#include "scene/settings.h"

const char *const aov_names[] = {"albedo",   "normal",    "depth",    "uv",
                                 "bvh_cost", "mip_level", "variance", NULL};

/* The structure that is used unless one is named: build.mk knows whether the
 * BVH is the reference's. */
#ifndef RAYBOOK_ACCEL
#define RAYBOOK_ACCEL "bvh"
#endif

/* Reads one option's value (NULL when it takes none); false fills *err. */
typedef bool set_fn(struct options *o, const char *name, const char *value,
                    struct error *err);

//> options.values: Read the value of each option
static bool set_output(struct options *o, const char *name, const char *value,
                       struct error *err)
{
    o->output = value;
    return option_has_ending(value, ".exr") ||
           option_has_ending(value, ".png") ||
           option_wrong(name, value, "a file name that ends in .exr or .png",
                        err);
}

static bool set_png(struct options *o, const char *name, const char *value,
                    struct error *err)
{
    o->png = value;
    return option_has_ending(value, ".png") ||
           option_wrong(name, value, "a file name that ends in .png", err);
}

static bool set_spp(struct options *o, const char *name, const char *value,
                    struct error *err)
{
    return option_read_int(name, value, SPP_MAX, &o->spp, err);
}

static bool set_seed(struct options *o, const char *name, const char *value,
                     struct error *err)
{
    long long seed;
    if (!option_read_whole(name, value, 0, INT64_C(1) << 53, &seed, err))
        return false;
    o->seed = seed;
    return true;
}

static bool set_threads(struct options *o, const char *name, const char *value,
                        struct error *err)
{
    return option_read_int(name, value, 1024, &o->threads, err);
}

static bool set_depth(struct options *o, const char *name, const char *value,
                      struct error *err)
{
    return option_read_int(name, value, DEPTH_MAX, &o->max_depth, err);
}

static bool set_resolution(struct options *o, const char *name,
                           const char *value, struct error *err)
{
    int size[2];
    if (!option_read_list(value, 'x', 2, size) || size[0] < 1 || size[1] < 1)
        return option_wrong(name, value, "WIDTHxHEIGHT, such as 640x480", err);
    if ((int64_t)size[0] * size[1] > FILM_MAX_PIXELS)
        return error_set(err, "%s %s: too many pixels, expected at most %d",
                         name, value, FILM_MAX_PIXELS);
    o->width = size[0];
    o->height = size[1];
    return true;
}

static bool set_crop(struct options *o, const char *name, const char *value,
                     struct error *err)
{
    int edge[4];
    if (!option_read_list(value, ',', 4, edge) || edge[0] >= edge[2] ||
        edge[1] >= edge[3])
        return option_wrong(name, value, "X0,Y0,X1,Y1 with X0 < X1 and Y0 < Y1",
                            err);
    o->has_crop = true;
    o->crop = (struct window){edge[0], edge[1], edge[2], edge[3]};
    return true;
}

static bool set_accel(struct options *o, const char *name, const char *value,
                      struct error *err)
{
    int kind = option_read_name(name, value, accel_names, err);
    if (kind < 0)
        return false;
    o->accel = (enum accel_kind)kind;
    return accel_available(o->accel) ||
           error_set(err,
                     "%s %s: this build has no Embree: install libembree-dev "
                     "and build again",
                     name, value);
}

static bool set_integrator(struct options *o, const char *name,
                           const char *value, struct error *err)
{
    o->integrator = option_read_name(name, value, integrator_names, err);
    return o->integrator >= 0;
}

static bool set_override(struct options *o, const char *name, const char *value,
                         struct error *err)
{
    (void)name, (void)err; /* its text is checked with the scene's */
    o->override = value;
    return true;
}

static bool set_time_limit(struct options *o, const char *name,
                           const char *value, struct error *err)
{
    char *end;
    o->time_limit = strtod(value, &end);
    if (end != value && *end == '\0' && o->time_limit > 0.0 &&
        o->time_limit < 1e9)
        return true;
    return option_wrong(name, value, "a number of seconds above 0", err);
}

static bool set_stats(struct options *o, const char *name, const char *value,
                      struct error *err)
{
    (void)name, (void)err;
    o->stats = value;
    return true;
}

static bool set_quiet(struct options *o, const char *name, const char *value,
                      struct error *err)
{
    (void)name, (void)value, (void)err;
    return o->quiet = true;
}

static bool set_help(struct options *o, const char *name, const char *value,
                     struct error *err)
{
    (void)name, (void)value, (void)err;
    return o->help = true;
}

static bool set_version(struct options *o, const char *name, const char *value,
                        struct error *err)
{
    (void)name, (void)value, (void)err;
    return o->version = true;
}

/* A comma-separated list of names. */
static bool set_aov(struct options *o, const char *name, const char *value,
                    struct error *err)
{
    while (*value != '\0') {
        char word[32];
        size_t length = strcspn(value, ",");
        snprintf(word, sizeof word, "%.*s", (int)length, value);
        int index = option_read_name(name, word, aov_names, err);
        if (index < 0)
            return false;
        o->aovs |= 1u << index;
        value += length + (value[length] == ',');
    }
    return o->aovs != 0 || option_wrong(name, value, "a list of channels", err);
}

static bool set_pixel(struct options *o, const char *name, const char *value,
                      struct error *err)
{
    int place[2];
    if (!option_read_list(value, ',', 2, place))
        return option_wrong(name, value, "X,Y", err);
    o->has_pixel = true;
    o->pixel_x = place[0];
    o->pixel_y = place[1];
    return true;
}

static bool set_preview(struct options *o, const char *name, const char *value,
                        struct error *err)
{
    (void)name, (void)value, (void)err;
    return o->preview = true;
}

static bool set_tev(struct options *o, const char *name, const char *value,
                    struct error *err)
{
    (void)name, (void)err;
    o->tev = value != NULL ? value : "127.0.0.1:14158";
    return true;
}

//< options.values

//> options.table: The table of all options
/* value: how the help names it; NULL: the option stands alone. A value in
 * brackets may be left out; it is then given only behind '='. */
static const struct option {
    const char *name, *letter, *value, *help;
    set_fn *set;
} table[] = {
    {"--output", "-o", "FILE",
     "the image: .exr (32-bit float) or .png (tone-mapped);\n"
     "default: the scene's name + .exr, in the current folder",
     set_output},
    {"--png", NULL, "FILE", "also write a tone-mapped preview", set_png},
    {"--spp", NULL, "N", "samples a pixel", set_spp},
    {"--seed", NULL, "N", "of the random numbers (default 0)", set_seed},
    {"--threads", NULL, "N", "default: one a processor", set_threads},
    {"--resolution", NULL, "WxH", "pixels, such as 640x480", set_resolution},
    {"--max-depth", NULL, "N", "longest chain of glass or mirrors", set_depth},
    {"--integrator", NULL, "NAME",
     "intersection_test, direct, path, normal, depth, uv,\n"
     "bvh_cost or mip_level",
     set_integrator},
    {"--accel", NULL, "NAME",
     "wide, bvh (the one that students write), linear (tests\n"
     "everything) or embree; default: " RAYBOOK_ACCEL,
     set_accel},
    {"--override", NULL, "JSON",
     "merged into the scene, such as\n"
     "'{\"film\": {\"resolution\": [64, 64]}}'",
     set_override},
    {"--aov", NULL, "LIST",
     "more EXR channels: albedo, normal, depth, uv, bvh_cost,\n"
     "mip_level, variance",
     set_aov},
    {"--pixel", NULL, "X,Y",
     "render that one pixel and print the tree of its paths", set_pixel},
    {"--crop", NULL, "X0,Y0,X1,Y1", "render only that window", set_crop},
    {"--time-limit", NULL, "S",
     "stop after S seconds, with the same number of samples\n"
     "in every pixel",
     set_time_limit},
    {"--stats", NULL, "FILE|-", "counters and times, as JSON", set_stats},
    {"--preview", NULL, NULL,
     "show the picture in the terminal while it renders", set_preview},
    {"--tev", NULL, "[=HOST:PORT]",
     "send the picture to a running tev viewer\n"
     "(default 127.0.0.1:14158)",
     set_tev},
    {"--quiet", "-q", NULL, "say nothing but errors", set_quiet},
    {"--help", "-h", NULL, "this text", set_help},
    {"--version", NULL, NULL, "the version", set_version},
};

enum { OPTION_COUNT = sizeof table / sizeof table[0] };
//< options.table

//> options.parse: Find each argument in the table
static const struct option *find_option(const char *text, size_t length)
{
    for (int i = 0; i < OPTION_COUNT; i++) {
        const struct option *o = &table[i];
        if (strlen(o->name) == length && strncmp(o->name, text, length) == 0)
            return o;
        if (o->letter != NULL && strcmp(o->letter, text) == 0)
            return o;
    }
    return NULL;
}

static bool unknown_option(const char *text, struct error *err)
{
    const char *names[OPTION_COUNT + 1] = {NULL};
    for (int i = 0; i < OPTION_COUNT; i++)
        names[i] = table[i].name;
    const char *near = nearest_name(text, names);
    if (near != NULL)
        return error_set(err, "unknown option %s: did you mean %s?", text,
                         near);
    return error_set(err, "unknown option %s (try --help)", text);
}

static bool set_scene(struct options *o, const char *text, struct error *err)
{
    if (o->scene != NULL)
        return error_set(err, "%s: expected one scene file, there is %s too",
                         text, o->scene);
    o->scene = text;
    return true;
}

/* One argument; its value may be the next one or stand behind '='. */
static bool parse_one(struct options *out, int *i, int argc, char *argv[],
                      struct error *err)
{
    const char *text = argv[*i];
    if (text[0] != '-' || text[1] == '\0')
        return set_scene(out, text, err);
    const char *equals = strchr(text, '=');
    size_t length = equals ? (size_t)(equals - text) : strlen(text);
    const struct option *option = find_option(text, length);
    if (option == NULL)
        return unknown_option(text, err);
    if (option->value == NULL && equals != NULL)
        return error_set(err, "%s takes no value", option->name);
    bool optional = option->value != NULL && option->value[0] == '[';
    if (option->value == NULL || (optional && equals == NULL))
        return option->set(out, option->name, NULL, err);
    if (equals == NULL && *i + 1 >= argc)
        return error_set(err, "%s: the value is missing, expected %s",
                         option->name, option->value);
    const char *value = equals ? equals + 1 : argv[++*i];
    return option->set(out, option->name, value, err);
}

//< options.parse

bool options_parse(int argc, char *argv[], struct options *out,
                   struct error *err)
{
    static const struct options none;
    *out = none;
    out->seed = -1;
    out->integrator = -1;
    if (!set_accel(out, "--accel", RAYBOOK_ACCEL, err))
        return false;
    for (int i = 1; i < argc; i++)
        if (!parse_one(out, &i, argc, argv, err))
            return false;
    if (out->scene == NULL && !out->help && !out->version)
        return error_set(err, "no scene file given (try --help)");
    return true;
}

//> options.help: Print the help from the same table
static void print_option(const struct option *o)
{
    char left[40];
    snprintf(left, sizeof left, "%s%s%s %s", o->letter ? o->letter : "",
             o->letter ? ", " : "    ", o->name, o->value ? o->value : "");
    printf("  %-28s", left);
    for (const char *c = o->help; *c != '\0'; c++) {
        putchar(*c);
        if (*c == '\n')
            printf("%30s", "");
    }
    putchar('\n');
}

void options_print_help(void)
{
    puts("usage: raybook [options] scene.json\n\n"
         "Renders a scene into an image. The formats of scene and image are "
         "in the book.\n");
    for (int i = 0; i < OPTION_COUNT; i++)
        if (table[i].help != NULL)
            print_option(&table[i]);
    puts("\nexit code: 0 done, 2 bad input or usage, 1 anything else");
}
//< options.help
