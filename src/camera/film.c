/* film.c - see film.h. */
#include "camera/film.h"

#include "base/memory.h"

struct film film_make(int width, int height)
{
    struct film film = {width, height, NULL};
    film.pixels =
        mem_alloc((size_t)width * (size_t)height, sizeof *film.pixels);
    return film;
}

static rgb mean(const struct film_pixel *p)
{
    double k = p->samples > 0 ? 1.0 / p->samples : 0.0;
    return rgb_make((float)(p->sum[0] * k), (float)(p->sum[1] * k),
                    (float)(p->sum[2] * k));
}

struct image film_develop(const struct film *film, int x0, int y0, int x1,
                          int y1)
{
    struct image image = image_make(x1 - x0, y1 - y0);
    rgb *out = image.pixels;
    for (int y = y0; y < y1; y++)
        for (int x = x0; x < x1; x++)
            *out++ = mean(
                &film->pixels[(size_t)y * (size_t)film->width + (size_t)x]);
    return image;
}

void film_free(struct film *film)
{
    mem_free(film->pixels);
    film->pixels = NULL;
}
