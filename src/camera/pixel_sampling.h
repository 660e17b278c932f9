/* pixel_sampling.h - assignment 06: the samples of a pixel, and what becomes
 * of them.
 *
 * A pixel is not a point. It is a weighted average of the picture around its
 * centre; the film's filter says how far around, and how much each place
 * counts. An average over a surface is estimated from samples: look at
 * n places, and average what is seen there.
 *
 *     film, in pixels: x to the right, y down; pixel (x, y) is the square
 *     from (x, y) to (x + 1, y + 1), so its centre is (x + 0.5, y + 0.5)
 *
 * Source: M. Pharr, W. Jakob, G. Humphreys, "Physically Based Rendering", 4th
 * edition, section 8.8 (filters); R. Cook, "Stochastic Sampling in Computer
 * Graphics", ACM Transactions on Graphics 5(1), 1986. */
#ifndef RAYBOOK_CAMERA_PIXEL_SAMPLING_H
#define RAYBOOK_CAMERA_PIXEL_SAMPLING_H

#include <stdint.h>

#include "base/rgb.h"
#include "base/vec.h"
#include "camera/filter.h"

/* Where to look, and how much that counts. */
struct pixel_sample {
    vec2 place; /* on the film, in pixels: absolute, not from the centre */
    float weight;
};

/* Which of a pixel's samples: number `index` (from 0) of `count`. */
struct sample_number {
    uint32_t index, count;
    uint32_t shared; /* random bits, the same for all samples of the pixel */
};

/* Where sample `number` of pixel (x, y) looks.
 *
 * random: two numbers in [0, 1), this sample's own: uniform, and not related
 *   to those of another pixel. Those of the pixel's other samples are
 *   independent or, if the scene's sampler is a better one, spread evenly over
 *   the unit square. They are all that is needed; `number` is for those who
 *   want to spread the samples themselves.
 *
 * The answer depends on the arguments only. What must hold, for every filter:
 * - Reach: the place is at most filter->radius from the pixel's centre, along
 *   x and along y, but for the rounding of the place itself.
 * - Spread: take many pixels' samples together, moved to one centre. Anywhere
 *   around it they are as many, each counted by its weight, as the filter says:
 *   in proportion to filter_value(dx) filter_value(dy), with dx, dy from the
 *   centre. Where the filter is negative the weights are negative.
 * - The weights are 1 on average.
 * - Evenness: what is spread evenly stays spread evenly. If count is 4, 16 or
 *   64 and the numbers of the pixel's samples lie one in each cell of a square
 *   grid over the unit square, then, for a box filter, that grid laid over the
 *   reach holds equally many places in each column, and in each row.
 *
 * The simplest way has the framework's filter_sample do most of it. Any other
 * will do, such as places spread evenly over the reach, and weights. */
struct pixel_sample pixel_sample(const struct filter *filter, int x, int y,
                                 struct sample_number number, vec2 random);

/* The samples of one pixel so far. All zero: none. `samples` is how many there
 * are; what is in the other fields is pixel_add's and pixel_value's affair.
 * They are doubles: after 2^24 equal samples a float would no longer notice
 * the next one. */
struct pixel_sums {
    double sum[3];
    double weight;
    uint32_t samples;
};

/* One more sample: what was seen, in linear RGB, any size and finite, and the
 * weight that pixel_sample gave it. */
void pixel_add(struct pixel_sums *sums, rgb radiance, float weight);

/* The pixel: the weighted mean of its samples,
 *
 *     (w_1 L_1 + ... + w_n L_n) / (w_1 + ... + w_n),
 *
 * black if there are none. It may be negative or larger than 1. Weights of
 * both signs may add up to nearly nothing: where their sum is below a tenth of
 * n, divide by n instead, which is what the weights add up to on average.
 *
 * Accuracy asked for: 1e-6 of the same sum with each term's absolute value, up
 * to a million samples. */
rgb pixel_value(const struct pixel_sums *sums);

#endif
