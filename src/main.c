/* main.c - raybook: renders a scene file into an image. */
#define _POSIX_C_SOURCE 200809L

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef _OPENMP
#include <omp.h>
#endif

#include "base/memory.h"
#include "image/exr.h"
#include "image/png.h"
#include "image/replace.h"
#include "integrators/render.h"
#include "program/options.h"
#include "program/progress.h"
#include "program/statistics.h"
#include "scene/load.h"

#ifndef RAYBOOK_VERSION
#define RAYBOOK_VERSION "unknown"
#endif
#ifndef RAYBOOK_VARIANT
#define RAYBOOK_VARIANT "reference"
#endif

enum { EXIT_BAD_INPUT = 2 };

static volatile sig_atomic_t interrupted;

static void on_interrupt(int signal_number)
{
    (void)signal_number;
    interrupted = 1;
}

/* The first Ctrl-C ends the rendering and keeps the picture; SA_RESETHAND
 * makes the second one end the program. */
static void catch_interrupt(void)
{
    struct sigaction action;
    memset(&action, 0, sizeof action);
    action.sa_handler = on_interrupt;
    action.sa_flags = (int)SA_RESETHAND;
    sigaction(SIGINT, &action, NULL);
}

/* The scene's own settings, replaced where the command line says so. */
static bool apply_options(const struct options *o, struct scene *scene,
                          struct error *err)
{
    if (o->spp > 0)
        scene->integrator.spp = o->spp;
    if (o->max_depth > 0)
        scene->integrator.max_depth = o->max_depth;
    if (o->seed >= 0)
        scene->integrator.seed = (uint64_t)o->seed;
    if (o->width > 0) {
        scene->film.width = o->width;
        scene->film.height = o->height;
    }
    if (o->has_crop &&
        (o->crop.x1 > scene->film.width || o->crop.y1 > scene->film.height))
        return error_set(err, "--crop: the window leaves the film of %d x %d",
                         scene->film.width, scene->film.height);
    return true;
}

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

struct session {
    struct options options;
    struct scene scene;
    struct film film;
    struct window window;
    struct progress_bar bar;
    struct statistics statistics;
    double deadline; /* of progress_clock; 0: none */
    char *command;
    char *output;
};

static bool should_stop(void *user, uint64_t samples_done)
{
    struct session *s = user;
    progress_update(&s->bar, samples_done);
    return interrupted || (s->deadline > 0.0 && progress_clock() > s->deadline);
}

static int threads_used(const struct options *o)
{
#ifdef _OPENMP
    return o->threads > 0 ? o->threads : omp_get_max_threads();
#else
    (void)o;
    return 1;
#endif
}

static bool load(struct session *s, struct error *err)
{
    double start = progress_clock();
    if (!scene_load(s->options.scene, s->options.override, &s->scene, err) ||
        !apply_options(&s->options, &s->scene, err))
        return false;
    double loaded = progress_clock();
    if (!scene_prepare(&s->scene, s->options.accel, err))
        return false;
    s->statistics.load_seconds = loaded - start;
    s->statistics.build_seconds = progress_clock() - loaded;
    return true;
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

static void draw(struct session *s)
{
    const struct film_settings *f = &s->scene.film;
    struct window whole = {0, 0, f->width, f->height};
    s->window = s->options.has_crop ? s->options.crop : whole;
    struct render_options how = {s->window, s->options.threads, should_stop,
                                 s->options.time_limit > 0.0, s};
    uint64_t pixels = (uint64_t)(s->window.x1 - s->window.x0) *
                      (uint64_t)(s->window.y1 - s->window.y0);
    s->film = film_make(f->width, f->height);
    s->bar = progress_start(pixels * (uint64_t)s->scene.integrator.spp,
                            s->options.quiet);
    double start = progress_clock();
    if (s->options.time_limit > 0.0)
        s->deadline = start + s->options.time_limit;
    catch_interrupt();
    render(&s->scene, &how, &s->film, &s->statistics.counters);
    s->statistics.render_seconds = progress_clock() - start;
    progress_end(&s->bar);
}

static bool write_exr(const struct session *s, const struct image *image,
                      uint32_t spp, struct error *err)
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
        {"raybook:command", s->command},
    };
    return exr_write(s->output, image, attributes,
                     (int)(sizeof attributes / sizeof attributes[0]), err);
}

static bool write_image(const struct session *s, const struct image *image,
                        uint32_t spp, struct error *err)
{
    bool is_png = strcmp(strrchr(s->output, '.'), ".png") == 0;
    if (is_png ? !png_write(s->output, image, err)
               : !write_exr(s, image, spp, err))
        return false;
    return s->options.png == NULL || png_write(s->options.png, image, err);
}

/* What a person wants to know at the end. */
static void say_done(const struct session *s, uint32_t spp)
{
    const struct statistics *t = &s->statistics;
    if (s->options.quiet)
        return;
    fprintf(stderr, "%s: %d x %d, %lu spp, %.2f s, %.2f Msamples/s%s\n",
            s->output, s->window.x1 - s->window.x0, s->window.y1 - s->window.y0,
            (unsigned long)spp, t->render_seconds,
            1e-6 * (double)t->counters.samples / t->render_seconds,
            interrupted ? " (interrupted: not all samples were taken)" : "");
    if (s->options.png != NULL)
        fprintf(stderr, "%s\n", s->options.png);
}

static bool write_results(struct session *s, struct error *err)
{
    struct image image = film_develop(&s->film, s->window.x0, s->window.y0,
                                      s->window.x1, s->window.y1);
    uint32_t spp = samples_everywhere(s);
    bool fine = write_image(s, &image, spp, err);
    image_free(&image);
    if (!fine)
        return false;
    say_done(s, spp);
    s->statistics.scene = &s->scene;
    s->statistics.accel = accel_names[s->options.accel];
    s->statistics.threads = threads_used(&s->options);
    return s->options.stats == NULL ||
           statistics_write(&s->statistics, s->options.stats, err);
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

static bool run(struct session *s, struct error *err)
{
    return load(s, err) && can_write(s->output, err) &&
           can_write(s->options.png, err) && can_write(s->options.stats, err);
}

static void release(struct session *s)
{
    scene_free(&s->scene);
    film_free(&s->film);
    mem_free(s->command);
    mem_free(s->output);
}

static int render_session(struct session *s, struct error *err)
{
    if (!run(s, err))
        return EXIT_BAD_INPUT;
    draw(s);
    return write_results(s, err) ? EXIT_SUCCESS : EXIT_FAILURE;
}

int main(int argc, char *argv[])
{
    struct session s;
    struct error err = {""};
    int code = EXIT_BAD_INPUT;
    memset(&s, 0, sizeof s);
    if (options_parse(argc, argv, &s.options, &err)) {
        if (s.options.help || s.options.version) {
            if (s.options.help)
                options_print_help();
            else
                puts("raybook " RAYBOOK_VERSION " (" RAYBOOK_VARIANT ")");
            return EXIT_SUCCESS;
        }
        s.command = command_line(argc, argv);
        s.output = s.options.output ? mem_copy_string(s.options.output)
                                    : default_output(s.options.scene);
        code = render_session(&s, &err);
    }
    if (code != EXIT_SUCCESS)
        fprintf(stderr, "raybook: %s\n", err.text);
    release(&s);
    return code;
}
