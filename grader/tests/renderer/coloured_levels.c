/* coloured_levels.c - a scene's picture with one colour a mip level.
 *
 *     coloured_levels SCENE.json OUT.exr COLOURS.txt
 *
 * Line k of COLOURS.txt (red green blue) is the colour of level k. All texels
 * of that level of every image texture are painted with it, and the scene is
 * rendered: the levels that a lookup mixed can be read off the picture. */
#include <stdio.h>
#include <stdlib.h>

#include "image/exr.h"
#include "integrators/render.h"
#include "scene/json_reader.h"
#include "scene/load.h"

static void stop(const char *why)
{
    fprintf(stderr, "coloured_levels: %s\n", why);
    exit(2);
}

/* The number of colours read. */
static int read_colours(const char *path, rgb colours[MIPMAP_MAX_LEVELS])
{
    int count = 0;
    FILE *file = fopen(path, "r");
    if (file == NULL)
        stop("the colours cannot be read");
    rgb c;
    while (count < MIPMAP_MAX_LEVELS &&
           fscanf(file, "%f %f %f", &c.r, &c.g, &c.b) == 3)
        colours[count++] = c;
    fclose(file);
    return count;
}

static void paint(struct mipmap *m, const rgb colours[], int count)
{
    if (m->level_count > count)
        stop("a texture has more levels than there are colours");
    for (int k = 0; k < m->level_count; k++) {
        const struct image *level = &m->levels[k];
        size_t texels = (size_t)level->width * (size_t)level->height;
        for (size_t i = 0; i < texels; i++)
            level->pixels[i] = colours[k];
    }
}

static bool never(void *user, uint64_t samples_done)
{
    (void)user, (void)samples_done;
    return false;
}

/* What render adds up becomes an image file. */
static void write_picture(const struct scene *scene, const char *path,
                          struct error *err)
{
    int width = scene->film.width, height = scene->film.height;
    struct film film = film_make(width, height, false);
    struct counters total = {0};
    struct render_options options = {.window = {0, 0, width, height},
                                     .stop = never};
    render(scene, &options, &film, &total);
    struct image picture = film_develop(&film, 0, 0, width, height);
    if (!exr_write(path, &picture, NULL, 0, err))
        stop(err->text);
    image_free(&picture);
    film_free(&film);
}

int main(int argc, char *argv[])
{
    struct scene scene;
    struct error err = {""};
    rgb colours[MIPMAP_MAX_LEVELS];
    if (argc != 4)
        stop("usage: coloured_levels SCENE.json OUT.exr COLOURS.txt");
    json_set_up();
    int count = read_colours(argv[3], colours);
    if (!scene_load(argv[1], NULL, &scene, &err))
        stop(err.text);
    for (uint32_t i = 0; i < scene.texture_count; i++)
        if (scene.textures[i].kind == TEXTURE_IMAGE)
            paint(&scene.textures[i].image.mipmap, colours, count);
    if (!scene_prepare(&scene, ACCEL_BVH, &err))
        stop(err.text);
    write_picture(&scene, argv[2], &err);
    scene_free(&scene);
    return 0;
}
