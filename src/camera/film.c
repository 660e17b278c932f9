/* film.c - see film.h. */
#include "camera/film.h"

#include "base/memory.h"

const char *const aov_channel_names[AOV_CHANNELS] = {
    "albedo.R", "albedo.G", "albedo.B", "normal.X", "normal.Y", "normal.Z",
    "depth.Z",  "uv.U",     "uv.V",     "bvh_cost", "mip_level"};

struct film film_make(int width, int height, bool with_aovs)
{
    struct film film = {width, height, NULL, NULL};
    size_t count = (size_t)width * (size_t)height;
    film.pixels = mem_alloc(count, sizeof *film.pixels);
    if (with_aovs)
        film.aovs = mem_alloc(count, AOV_CHANNELS * sizeof *film.aovs);
    return film;
}

void film_add(struct film_pixel *pixel, rgb radiance, float weight)
{
    double luminance = (double)rgb_luminance(radiance);
    double from_mean = luminance - pixel->mean;
    pixel_add(&pixel->sums, radiance, weight);
    pixel->mean += from_mean / pixel->sums.samples;
    pixel->spread += from_mean * (luminance - pixel->mean);
}

static size_t index_of(const struct film *film, int x, int y)
{
    return (size_t)y * (size_t)film->width + (size_t)x;
}

struct image film_develop(const struct film *film, int x0, int y0, int x1,
                          int y1)
{
    struct image image = image_make(x1 - x0, y1 - y0);
    rgb *out = image.pixels;
    for (int y = y0; y < y1; y++)
        for (int x = x0; x < x1; x++)
            *out++ = pixel_value(&film->pixels[index_of(film, x, y)].sums);
    return image;
}

float film_aov(const struct film *film, int x, int y, int channel)
{
    size_t i = index_of(film, x, y);
    uint32_t samples = film->pixels[i].sums.samples;
    double sum = film->aovs[AOV_CHANNELS * i + (size_t)channel];
    return samples > 0 ? (float)(sum / samples) : 0.0f;
}

float film_variance(const struct film *film, int x, int y)
{
    const struct film_pixel *p = &film->pixels[index_of(film, x, y)];
    double n = p->sums.samples;
    return n > 1.0 ? (float)(p->spread / (n - 1.0) / n) : 0.0f;
}

void film_free(struct film *film)
{
    mem_free(film->pixels);
    mem_free(film->aovs);
    film->pixels = NULL;
    film->aovs = NULL;
}
