/* results.c - see results.h. */
#include "program/results.h"

#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "image/exr.h"
#include "image/png.h"
#include "image/replace.h"
#include "program/version.h"

/* "scenes/box.json" becomes "box.exr"; the caller owns the answer. */
static char *default_output(const char *scene)
{
    const char *slash = strrchr(scene, '/');
    const char *name = slash ? slash + 1 : scene;
    const char *dot = strrchr(name, '.');
    size_t length = dot && dot > name ? (size_t)(dot - name) : strlen(name);
    char *path = mem_alloc(length + sizeof ".exr", 1);
    memcpy(path, name, length);
    strcpy(path + length, ".exr");
    return path;
}

/* All arguments with blanks between, for the image's header. */
static char *command_line(int argc, char *argv[])
{
    size_t size = 1;
    for (int i = 0; i < argc; i++)
        size += strlen(argv[i]) + 1;
    char *line = mem_alloc(size, 1);
    for (int i = 0; i < argc; i++) {
        strcat(line, i > 0 ? " " : "");
        strcat(line, argv[i]);
    }
    return line;
}

struct results results_make(const struct options *o, int argc, char *argv[])
{
    struct results r;
    r.command = command_line(argc, argv);
    r.output =
        o->output ? mem_copy_string(o->output) : default_output(o->scene);
    return r;
}

/* A place that cannot be written is told before the work, not after it. */
static bool can_write(const char *path, struct error *err)
{
    struct replacement probe;
    if (path == NULL || strcmp(path, "-") == 0)
        return true;
    if (!replace_begin(&probe, path, err))
        return false;
    replace_abandon(&probe);
    return true;
}

bool results_possible(const struct results *r, const struct options *o,
                      struct error *err)
{
    bool is_png = strcmp(strrchr(r->output, '.'), ".png") == 0;
    if (is_png && o->aovs != 0)
        return error_set(err,
                         "--aov: %s: a PNG has no such channels, expected "
                         "an .exr file",
                         r->output);
    return can_write(r->output, err) && can_write(o->png, err) &&
           can_write(o->stats, err);
}

/* Fewest samples of any pixel in the window. */
static uint32_t samples_everywhere(const struct session *s)
{
    uint32_t fewest = UINT32_MAX;
    for (int y = s->window.y0; y < s->window.y1; y++)
        for (int x = s->window.x0; x < s->window.x1; x++) {
            size_t i = (size_t)y * (size_t)s->film.width + (size_t)x;
            uint32_t n = s->film.pixels[i].sums.samples;
            fewest = n < fewest ? n : fewest;
        }
    return fewest;
}

/* The extra channels that were asked for, as one block of rows of all of them,
 * and where each begins. */
struct extra_channels {
    float *values; /* owned */
    int count;
    const char *names[AOV_CHANNELS + 1];
    int source[AOV_CHANNELS + 1]; /* the film's channel; < 0: the variance */
};

/* Which group (bit of enum aov) each of the film's channels belongs to. */
static const unsigned channel_group[AOV_CHANNELS] = {
    AOV_BIT_ALBEDO, AOV_BIT_ALBEDO,   AOV_BIT_ALBEDO,   AOV_BIT_NORMAL,
    AOV_BIT_NORMAL, AOV_BIT_NORMAL,   AOV_BIT_DEPTH,    AOV_BIT_UV,
    AOV_BIT_UV,     AOV_BIT_BVH_COST, AOV_BIT_MIP_LEVEL};

static void list_channels(unsigned aovs, struct extra_channels *out)
{
    out->count = 0;
    for (int i = 0; i < AOV_CHANNELS; i++)
        if (aovs & channel_group[i]) {
            out->names[out->count] = aov_channel_names[i];
            out->source[out->count++] = i;
        }
    if (aovs & AOV_BIT_VARIANCE) {
        out->names[out->count] = "variance";
        out->source[out->count++] = -1;
    }
}

static struct extra_channels extra_channels(const struct session *s)
{
    struct extra_channels extra = {0};
    const struct window *w = &s->window;
    list_channels(s->options.aovs, &extra);
    size_t pixels = (size_t)(w->x1 - w->x0) * (size_t)(w->y1 - w->y0);
    extra.values = mem_alloc(pixels * (size_t)extra.count + 1, sizeof(float));
    float *out = extra.values;
    for (int y = w->y0; y < w->y1; y++)
        for (int x = w->x0; x < w->x1; x++)
            for (int i = 0; i < extra.count; i++)
                *out++ = extra.source[i] < 0
                             ? film_variance(&s->film, x, y)
                             : film_aov(&s->film, x, y, extra.source[i]);
    return extra;
}

static bool write_channels(const struct results *r, const struct session *s,
                           const struct image *image,
                           const struct exr_attribute attributes[], int count,
                           struct error *err)
{
    struct extra_channels extra = extra_channels(s);
    struct exr_channel channels[AOV_CHANNELS + 4] = {
        {"R", &image->pixels->r, 3},
        {"G", &image->pixels->g, 3},
        {"B", &image->pixels->b, 3}};
    for (int i = 0; i < extra.count; i++) {
        channels[3 + i].name = extra.names[i];
        channels[3 + i].values = extra.values + i;
        channels[3 + i].stride = extra.count;
    }
    bool fine =
        exr_write_channels(r->output, image->width, image->height, channels,
                           3 + extra.count, attributes, count, err);
    mem_free(extra.values);
    return fine;
}

static bool write_exr(const struct results *r, const struct session *s,
                      const struct image *image, uint32_t spp,
                      struct error *err)
{
    char seed[32], samples[32];
    snprintf(seed, sizeof seed, "%llu",
             (unsigned long long)s->scene.integrator.seed);
    snprintf(samples, sizeof samples, "%lu", (unsigned long)spp);
    const struct exr_attribute attributes[] = {
        {"raybook:scene", s->options.scene},
        {"raybook:seed", seed},
        {"raybook:spp", samples},
        {"raybook:version", RAYBOOK_VERSION},
        {"raybook:variant", RAYBOOK_VARIANT},
        {"raybook:command", r->command},
    };
    return write_channels(r, s, image, attributes,
                          (int)(sizeof attributes / sizeof attributes[0]), err);
}

static bool write_image(const struct results *r, const struct session *s,
                        const struct image *image, uint32_t spp,
                        struct error *err)
{
    bool is_png = strcmp(strrchr(r->output, '.'), ".png") == 0;
    if (is_png ? !png_write(r->output, image, err)
               : !write_exr(r, s, image, spp, err))
        return false;
    return s->options.png == NULL || png_write(s->options.png, image, err);
}

/* What a person wants to know at the end. */
static void say_done(const struct results *r, const struct session *s,
                     uint32_t spp)
{
    const struct statistics *t = &s->statistics;
    if (s->options.quiet)
        return;
    fprintf(stderr, "%s: %d x %d, %lu spp, %.2f s, %.2f Msamples/s%s\n",
            r->output, s->window.x1 - s->window.x0, s->window.y1 - s->window.y0,
            (unsigned long)spp, t->render_seconds,
            1e-6 * (double)t->counters.samples / t->render_seconds,
            s->interrupted ? " (interrupted: not all samples were taken)" : "");
    if (s->options.png != NULL)
        fprintf(stderr, "%s\n", s->options.png);
}

bool results_write(const struct results *r, const struct session *s,
                   struct error *err)
{
    if (s->options.has_pixel && s->options.output == NULL)
        return true; /* the words were what was asked for */
    struct image image = film_develop(&s->film, s->window.x0, s->window.y0,
                                      s->window.x1, s->window.y1);
    uint32_t spp = samples_everywhere(s);
    bool fine = write_image(r, s, &image, spp, err);
    image_free(&image);
    if (!fine)
        return false;
    say_done(r, s, spp);
    return s->options.stats == NULL ||
           statistics_write(&s->statistics, s->options.stats, err);
}

void results_free(struct results *r)
{
    mem_free(r->output);
    mem_free(r->command);
}
