/* bench_image.c - renders one scene again and again, when it is told to.
 *
 *     bench image SCENE.json ACCELERATOR ...
 *
 * Loads the scene, builds the first of the accelerators that this build has,
 * and says "ready NAME". Then for each line "SEED SPP THREADS FILE" on its
 * standard input it renders, writes the picture to FILE as raw 32-bit floats
 * (rows from the top, R G B), and answers "CPU WALL": the seconds from an
 * empty film to a developed picture. bench_mitsuba.py speaks the same. */
#include "bench_commands.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench_clock.h"
#include "bench_scene.h"
#include "image/image.h"
#include "integrators/render.h"
#include "scene/json_reader.h"
#include "scene/load.h"

enum { PATH_SIZE = 1024 };

static void stop(const char *what)
{
    fprintf(stderr, "bench_image: %s\n", what);
    exit(EXIT_FAILURE);
}

static enum accel_kind choose(char *names[])
{
    for (; *names != NULL; names++)
        if (bench_accel_find(*names) >= 0)
            return (enum accel_kind)bench_accel_find(*names);
    stop("this build has none of these accelerators");
    return ACCEL_BVH;
}

static void load(struct scene *scene, char *argv[])
{
    struct error err = {""};
    json_set_up();
    memset(scene, 0, sizeof *scene);
    if (!scene_load(argv[1], NULL, scene, &err))
        stop(err.text);
    enum accel_kind kind = choose(argv + 2);
    if (!scene_prepare(scene, kind, &err))
        stop(err.text);
    printf("ready %s\n", accel_names[kind]);
    fflush(stdout);
}

static bool never(void *user, uint64_t samples_done)
{
    (void)user, (void)samples_done;
    return false;
}

static struct image take_picture(const struct scene *scene, int threads)
{
    int width = scene->film.width, height = scene->film.height;
    struct counters work = {0};
    struct render_options how = {
        .window = {0, 0, width, height}, .threads = threads, .stop = never};
    struct film film = film_make(width, height, false);
    render(scene, &how, &film, &work);
    struct image picture = film_develop(&film, 0, 0, width, height);
    film_free(&film);
    return picture;
}

static void write_floats(const char *path, const struct image *picture)
{
    size_t count = (size_t)picture->width * (size_t)picture->height;
    FILE *file = fopen(path, "wb");
    if (file == NULL ||
        fwrite(picture->pixels, sizeof *picture->pixels, count, file) !=
            count ||
        fclose(file) != 0)
        stop(path);
}

static void answer(struct scene *scene, int threads, const char *path)
{
    double wall = clock_wall(), cpu = clock_process();
    struct image picture = take_picture(scene, threads);
    cpu = clock_process() - cpu;
    wall = clock_wall() - wall;
    write_floats(path, &picture);
    image_free(&picture);
    printf("%.6f %.6f\n", cpu, wall);
    fflush(stdout);
}

int bench_image(int argc, char *argv[])
{
    struct scene scene;
    unsigned long long seed;
    int spp, threads;
    char path[PATH_SIZE];
    if (argc < 3) {
        fprintf(stderr, "usage: bench image SCENE.json ACCELERATOR ...\n");
        return 2;
    }
    load(&scene, argv);
    while (scanf("%llu %d %d %1023s", &seed, &spp, &threads, path) == 4) {
        scene.integrator.seed = seed;
        scene.integrator.spp = spp;
        answer(&scene, threads, path);
    }
    scene_free(&scene);
    return 0;
}
