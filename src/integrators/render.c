/* render.c - see render.h. */
#include "integrators/render.h"

#ifdef _OPENMP
#include <omp.h>
#endif

#include "camera/camera.h"
#include "camera/filter.h"
#include "integrators/intersection_test.h"
#include "sampling/sampler.h"

/* Small enough to share evenly between threads, large enough that handing
 * them out costs nothing. */
enum { TILE_SIDE = 16 };

struct job {
    const struct scene *scene;
    const struct render_options *options;
    struct camera camera;
    struct film *film;
    int first_sample, last_sample; /* of this pass; the last is not in it */
};

static rgb radiance(const struct scene *scene, const ray *r)
{
    switch (scene->integrator.kind) {
    case INTEGRATOR_INTERSECTION_TEST:
        break;
    }
    return intersection_test_radiance(scene, r);
}

static void render_sample(const struct job *job, int x, int y, int sample,
                          struct film_pixel *pixel)
{
    const struct scene *scene = job->scene;
    uint64_t index = (uint64_t)y * (uint64_t)job->film->width + (uint64_t)x;
    struct sampler sampler =
        sampler_start(scene->integrator.seed, index, (uint64_t)sample);
    vec2 offset =
        filter_box_sample(scene->film.filter_radius, sampler_2d(&sampler));
    vec2 place =
        vec2_make((float)x + 0.5f + offset.x, (float)y + 0.5f + offset.y);
    ray r = camera_ray(&job->camera, place);
    counters_mine.camera_rays++;
    film_add(pixel, radiance(scene, &r));
    counters_mine.samples++;
}

static void render_pixel(const struct job *job, int x, int y)
{
    size_t index = (size_t)y * (size_t)job->film->width + (size_t)x;
    struct film_pixel *pixel = &job->film->pixels[index];
    for (int s = job->first_sample; s < job->last_sample; s++)
        render_sample(job, x, y, s, pixel);
}

static int smaller(int a, int b)
{
    return a < b ? a : b;
}

/* Returns the number of samples taken. */
static uint64_t render_tile(const struct job *job, int x0, int y0)
{
    const struct window *w = &job->options->window;
    int x1 = smaller(x0 + TILE_SIDE, w->x1),
        y1 = smaller(y0 + TILE_SIDE, w->y1);
    for (int y = y0; y < y1; y++)
        for (int x = x0; x < x1; x++)
            render_pixel(job, x, y);
    return (uint64_t)(x1 - x0) * (uint64_t)(y1 - y0) *
           (uint64_t)(job->last_sample - job->first_sample);
}

/* Shared by the threads; only touched inside the critical section. */
struct progress {
    uint64_t samples;
    bool stopped;
};

static bool may_go_on(const struct job *job, struct progress *p)
{
    bool go_on = true;
#pragma omp critical(render_progress)
    {
        if (!p->stopped && job->options->stop(job->options->user, p->samples))
            p->stopped = true;
        go_on = !p->stopped || job->options->whole_passes;
    }
    return go_on;
}

static void count_samples(struct progress *p, uint64_t samples)
{
#pragma omp critical(render_progress)
    p->samples += samples;
}

static void render_pass(const struct job *job, struct progress *p,
                        struct counters *total)
{
    const struct window *w = &job->options->window;
    int columns = (w->x1 - w->x0 + TILE_SIDE - 1) / TILE_SIDE;
    int rows = (w->y1 - w->y0 + TILE_SIDE - 1) / TILE_SIDE;
#pragma omp parallel
    {
#pragma omp for schedule(dynamic)
        for (int tile = 0; tile < columns * rows; tile++) {
            if (!may_go_on(job, p))
                continue;
            count_samples(p,
                          render_tile(job, w->x0 + TILE_SIDE * (tile % columns),
                                      w->y0 + TILE_SIDE * (tile / columns)));
        }
#pragma omp critical(render_counters)
        counters_flush(total);
    }
}

/* 1, 2, 4 ... and at most 64 samples a pass: soon a whole picture, and a stop
 * is never far away. Where a stop waits for the pass to end, a pass adds an
 * eighth, so that it comes at most that much late. */
static int next_pass(int first_sample, int spp, bool whole_passes)
{
    int size = smaller(whole_passes ? first_sample / 8 : first_sample, 64);
    return smaller(first_sample + (size > 0 ? size : 1), spp);
}

bool render(const struct scene *scene, const struct render_options *options,
            struct film *film, struct counters *total)
{
    struct job job = {scene, options, camera_make(&scene->camera, &scene->film),
                      film,  0,       0};
    struct progress progress = {0, false};
#ifdef _OPENMP
    if (options->threads > 0)
        omp_set_num_threads(options->threads);
#endif
    while (job.last_sample < scene->integrator.spp && !progress.stopped) {
        job.first_sample = job.last_sample;
        job.last_sample = next_pass(job.first_sample, scene->integrator.spp,
                                    options->whole_passes);
        render_pass(&job, &progress, total);
    }
    return !progress.stopped;
}
