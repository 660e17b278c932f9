/* film.h - where samples are gathered into pixels. */
#ifndef RAYBOOK_CAMERA_FILM_H
#define RAYBOOK_CAMERA_FILM_H

#include <stdint.h>

#include "base/rgb.h"
#include "image/image.h"

/* Sums are in double: at 2^24 samples a float would have lost the last ones.
 * One thread at a time works on a pixel; different pixels are independent. */
struct film_pixel {
    double sum[3];
    uint32_t samples;
};

struct film {
    int width, height;
    struct film_pixel *pixels;
};

/* A film without samples; release with film_free. */
struct film film_make(int width, int height);

static inline void film_add(struct film_pixel *pixel, rgb radiance)
{
    pixel->sum[0] += (double)radiance.r;
    pixel->sum[1] += (double)radiance.g;
    pixel->sum[2] += (double)radiance.b;
    pixel->samples++;
}

/* The window of the film from (x0, y0) up to but without (x1, y1) as an image
 * that the caller owns: each pixel the mean of its samples, black if none. */
struct image film_develop(const struct film *film, int x0, int y0, int x1,
                          int y1);

void film_free(struct film *film);

#endif
