/* session.c - see session.h. */
#define _POSIX_C_SOURCE 200809L

#include "program/session.h"

#include <signal.h>
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

static int threads_used(const struct options *o)
{
#ifdef _OPENMP
    return o->threads > 0 ? o->threads : omp_get_max_threads();
#else
    (void)o;
    return 1;
#endif
}

bool session_load(struct session *s, struct error *err)
{
    double start = progress_clock();
    if (!scene_load(s->options.scene, s->options.override, &s->scene, err) ||
        !apply_options(&s->options, &s->scene, err))
        return false;
    double loaded = progress_clock();
    if (!scene_prepare(&s->scene, s->options.accel, err))
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

void session_render(struct session *s)
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
    s->interrupted = interrupted;
    progress_end(&s->bar);
}

void session_free(struct session *s)
{
    scene_free(&s->scene);
    film_free(&s->film);
}
