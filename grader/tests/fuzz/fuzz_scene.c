/* fuzz_scene.c - the scene loader, and the renderer with what it let pass. */
#include <stdbool.h>

#include "fuzz_file.h"
#include "integrators/render.h"
#include "scene/load.h"

enum { SIDE = 2, DEPTH = 6 };

static bool never(void *user, uint64_t samples_done)
{
    (void)user, (void)samples_done;
    return false;
}

/* Two by two pixels, one sample each: the numbers that make rendering long are
 * the user's to choose, and not what is tested here. */
static void render_little(struct scene *scene)
{
    struct counters work = {0};
    struct render_options how = {
        {0, 0, SIDE, SIDE}, 1, NULL, never, NULL, false, NULL};
    scene->film.width = scene->film.height = SIDE;
    scene->integrator.spp = 1;
    if (scene->integrator.max_depth > DEPTH)
        scene->integrator.max_depth = DEPTH;
    struct film film = film_make(SIDE, SIDE, true);
    render(scene, &how, &film, &work);
    film_free(&film);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct scene scene;
    struct error err = {""};
    const char *path = fuzz_file("fuzz.json", data, size);
    int fine = scene_load(path, NULL, &scene, &err) &&
               scene_prepare(&scene, ACCEL_BVH, &err);
    fuzz_check_message(fine, err.text);
    if (fine)
        render_little(&scene);
    scene_free(&scene);
    return 0;
}
