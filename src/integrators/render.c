/* render.c - see render.h. */
#include "integrators/render.h"

#ifdef _OPENMP
#include <omp.h>
#endif

#include "camera/camera.h"
#include "camera/filter.h"
#include "camera/pixel_sampling.h"
#include "integrators/intersection_test.h"
#include "integrators/path.h"
#include "integrators/tracer.h"
#include "integrators/views.h"

/* Small enough to share evenly between threads, large enough that handing
 * them out costs nothing. */
enum { TILE_SIDE = 16 };

struct job {
    const struct scene *scene;
    const struct render_options *options;
    struct camera camera;
    struct filter filter;
    struct film *film;
    int first_sample, last_sample; /* of this pass; the last is not in it */
    bool has_images;               /* as textures of what can be seen */
};

static bool has_images(const struct scene *scene)
{
    for (uint32_t i = 0; i < scene->object_count; i++) {
        const struct material *m = scene->objects[i].material;
        if (m != NULL && m->albedo != NULL && m->albedo->kind == TEXTURE_IMAGE)
            return true;
    }
    return false;
}

/* Only images are filtered; without them a pixel may as well be a point. */
static struct ray_differential differential(const struct job *job, vec2 place)
{
    static const struct ray_differential none;
    return job->has_images ? camera_differential(&job->camera, place) : none;
}

//> render.radiance: Let the integrator answer
static rgb view(const struct tracer *t, const ray *r,
                const struct ray_differential *d)
{
    struct first_hit h = first_hit(t, r, d);
    return view_color(t->scene->integrator.kind, &h);
}

static rgb radiance(const struct tracer *t, const ray *r,
                    const struct ray_differential *d)
{
    switch (t->scene->integrator.kind) {
    case INTEGRATOR_INTERSECTION_TEST:
        return intersection_test_radiance(t, *r, *d);
    case INTEGRATOR_DIRECT:
        return direct_radiance(t, *r, *d);
    case INTEGRATOR_PATH:
        return path_radiance(t, *r, *d);
    default:
        return view(t, r, d);
    }
}
//< render.radiance

static void add_aovs(const struct tracer *t, const ray *r,
                     const struct ray_differential *d, double *sums)
{
    struct first_hit h = first_hit(t, r, d);
    const float values[AOV_CHANNELS] = {
        h.albedo.r, h.albedo.g, h.albedo.b, h.normal.x, h.normal.y, h.normal.z,
        h.depth,    h.uv.x,     h.uv.y,     h.bvh_cost, h.mip_level};
    for (int i = 0; i < AOV_CHANNELS; i++)
        sums[i] += (double)values[i];
}

//> render.sample: Take one sample of one pixel
static struct sampler start_sample(const struct job *job, size_t pixel,
                                   int sample)
{
    const struct integrator_settings *s = &job->scene->integrator;
    return sampler_start(s->sampler, s->seed, pixel, (uint32_t)sample,
                         (uint32_t)s->spp);
}

static void render_sample(const struct job *job, int x, int y, int sample)
{
    size_t pixel = (size_t)y * (size_t)job->film->width + (size_t)x;
    struct sampler sampler = start_sample(job, pixel, sample);
    struct tracer t = {job->scene, &sampler, job->options->log};
    struct sample_number number = {(uint32_t)sample,
                                   (uint32_t)job->scene->integrator.spp,
                                   (uint32_t)(sampler.pixel_key >> 32)};
    struct pixel_sample at =
        pixel_sample(&job->filter, x, y, number, sampler_2d(&sampler));
    ray r = camera_ray(&job->camera, at.place);
    struct ray_differential d = differential(job, at.place);
    counters_mine.camera_rays++;
    path_log_camera(t.log, (uint32_t)sample, at.place, &r);
    rgb found = radiance(&t, &r, &d);
    path_log_result(t.log, found);
    film_add(&job->film->pixels[pixel], found, at.weight);
    t.log = NULL;
    if (job->film->aovs != NULL)
        add_aovs(&t, &r, &d, &job->film->aovs[AOV_CHANNELS * pixel]);
    counters_mine.samples++;
}

static void render_pixel(const struct job *job, int x, int y)
{
    for (int s = job->first_sample; s < job->last_sample; s++)
        render_sample(job, x, y, s);
}
//< render.sample

//> render.tiles: Share the tiles among the threads
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
//< render.tiles

//> render.passes: Go over the film again and again
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
    struct job job = {scene,
                      options,
                      camera_make(&scene->camera, &scene->film),
                      filter_make(&scene->film),
                      film,
                      0,
                      0,
                      has_images(scene)};
    struct progress progress = {0, false};
#ifdef _OPENMP
    int threads = options->log != NULL ? 1 : options->threads;
    if (threads > 0)
        omp_set_num_threads(threads);
#endif
    while (job.last_sample < scene->integrator.spp && !progress.stopped) {
        job.first_sample = job.last_sample;
        job.last_sample = next_pass(job.first_sample, scene->integrator.spp,
                                    options->whole_passes);
        render_pass(&job, &progress, total);
        if (options->pass_done != NULL)
            options->pass_done(options->user, film);
    }
    return !progress.stopped;
}
//< render.passes
