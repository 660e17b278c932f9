/* film.h - where samples are gathered into pixels. */
#ifndef RAYBOOK_CAMERA_FILM_H
#define RAYBOOK_CAMERA_FILM_H

#include <stdint.h>

#include "base/rgb.h"
#include "camera/pixel_sampling.h"
#include "image/image.h"

/* Extra channels that a film may carry, each the mean of a pixel's samples.
 * The names are those of the EXR file's channels. */
enum {
    AOV_ALBEDO = 0, /* 3: R, G, B */
    AOV_NORMAL = 3, /* 3: X, Y, Z */
    AOV_DEPTH = 6,
    AOV_UV = 7, /* 2: U, V */
    AOV_BVH_COST = 9,
    AOV_MIP_LEVEL = 10,
    AOV_CHANNELS = 11
};
extern const char *const aov_channel_names[AOV_CHANNELS];

/* One thread at a time works on a pixel; different pixels are independent. */
struct film_pixel {
    struct pixel_sums sums;
    double mean, spread; /* of luminance: running mean, sum of squared
                            deviations (B. Welford, Technometrics 4(3), 1962) */
};

struct film {
    int width, height;
    struct film_pixel *pixels;
    double *aovs; /* AOV_CHANNELS sums a pixel; NULL: none are kept */
};

/* A film without samples; release with film_free. */
struct film film_make(int width, int height, bool with_aovs);

/* One more sample; its weight is pixel_sample's. */
void film_add(struct film_pixel *pixel, rgb radiance, float weight);

/* The window of the film from (x0, y0) up to but without (x1, y1) as an image
 * that the caller owns: each pixel's pixel_value. */
struct image film_develop(const struct film *film, int x0, int y0, int x1,
                          int y1);

/* One extra channel of one pixel: the mean of its samples. */
float film_aov(const struct film *film, int x, int y, int channel);

/* The variance of the pixel's luminance as an estimate: of one sample's,
 * divided by their number; 0 below two samples. */
float film_variance(const struct film *film, int x, int y);

void film_free(struct film *film);

#endif
