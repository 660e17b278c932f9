/* session.c - see session.h. */
#define _POSIX_C_SOURCE 200809L

#include "program/session.h"

#include <signal.h>
#include <stdio.h>
#include <string.h>

#ifdef _OPENMP
#include <omp.h>
#endif

#include "scene/load.h"

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
    if (o->integrator >= 0)
        scene->integrator.kind = (enum integrator_kind)o->integrator;
    if (o->width > 0) {
        scene->film.width = o->width;
        scene->film.height = o->height;
    }
    if (o->has_crop &&
        (o->crop.x1 > scene->film.width || o->crop.y1 > scene->film.height))
        return error_set(err, "--crop: the window leaves the film of %d x %d",
                         scene->film.width, scene->film.height);
    if (o->has_pixel &&
        (o->pixel_x >= scene->film.width || o->pixel_y >= scene->film.height))
        return error_set(err, "--pixel: the film has %d x %d pixels",
                         scene->film.width, scene->film.height);
    return true;
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

/* Building uses threads, too. */
static void use_threads(const struct options *o)
{
#ifdef _OPENMP
    omp_set_num_threads(threads_used(o));
#else
    (void)o;
#endif
}

bool session_load(struct session *s, struct error *err)
{
    double start = progress_clock();
    use_threads(&s->options);
    if (!scene_load(s->options.scene, s->options.override, &s->scene, err) ||
        !apply_options(&s->options, &s->scene, err))
        return false;
    double loaded = progress_clock();
    if (!scene_prepare(&s->scene, s->options.accel, err))
        return false;
    s->preview.shown = s->options.preview && !s->options.quiet;
    if (s->options.tev != NULL &&
        !tev_connect(&s->viewer, s->options.tev, s->options.scene, err))
        return false;
    s->statistics.scene = &s->scene;
    s->statistics.accel = accel_names[s->options.accel];
    s->statistics.threads = threads_used(&s->options);
    s->statistics.load_seconds = loaded - start;
    s->statistics.build_seconds = progress_clock() - loaded;
    return true;
}

static bool should_stop(void *user, uint64_t samples_done)
{
    struct session *s = user;
    progress_update(&s->bar, samples_done);
    return interrupted || (s->deadline > 0.0 && progress_clock() > s->deadline);
}

static void show(void *user, const struct film *film)
{
    struct session *s = user;
    preview_show(&s->preview, film, &s->window);
    if (!s->viewer.connected)
        return;
    struct image image = film_develop(film, s->window.x0, s->window.y0,
                                      s->window.x1, s->window.y1);
    tev_send(&s->viewer, &image);
    image_free(&image);
}

static struct window window_of(const struct session *s)
{
    const struct options *o = &s->options;
    struct window whole = {0, 0, s->scene.film.width, s->scene.film.height};
    struct window pixel = {o->pixel_x, o->pixel_y, o->pixel_x + 1,
                           o->pixel_y + 1};
    if (o->has_pixel)
        return pixel;
    return o->has_crop ? o->crop : whole;
}

static void start_clock(struct session *s)
{
    const struct window *w = &s->window;
    uint64_t pixels = (uint64_t)(w->x1 - w->x0) * (uint64_t)(w->y1 - w->y0);
    s->bar = progress_start(pixels * (uint64_t)s->scene.integrator.spp,
                            s->options.quiet || s->options.has_pixel);
    if (s->options.time_limit > 0.0)
        s->deadline = progress_clock() + s->options.time_limit;
}

void session_render(struct session *s)
{
    const struct film_settings *f = &s->scene.film;
    struct path_log log = {stdout, 0};
    s->window = window_of(s);
    struct render_options how = {.window = s->window,
                                 .threads = s->options.threads,
                                 .log = s->options.has_pixel ? &log : NULL,
                                 .stop = should_stop,
                                 .pass_done = show,
                                 .user = s};
    s->film = film_make(f->width, f->height, s->options.aovs != 0);
    start_clock(s);
    how.whole_passes = s->deadline > 0.0;
    double start = progress_clock();
    catch_interrupt();
    render(&s->scene, &how, &s->film, &s->statistics.counters);
    s->statistics.render_seconds = progress_clock() - start;
    s->interrupted = interrupted;
    progress_end(&s->bar);
}

void session_free(struct session *s)
{
    scene_free(&s->scene);
    film_free(&s->film);
    tev_close(&s->viewer);
}
