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
            uint32_t n = s->film.pixels[i].samples;
            fewest = n < fewest ? n : fewest;
        }
    return fewest;
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
    return exr_write(r->output, image, attributes,
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
