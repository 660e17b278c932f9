/* color_sum.h - weighted means of colours. */
#ifndef RAYBOOK_TEXTURES_COLOR_SUM_H
#define RAYBOOK_TEXTURES_COLOR_SUM_H

#include "base/rgb.h"

/* A sum of weighted colours, in double so that a mean keeps its digits. Start
 * with all zeros. */
struct color_sum {
    double r, g, b, weight;
};

static inline void color_sum_add(struct color_sum *sum, rgb color,
                                 double weight)
{
    sum->r += weight * color.r;
    sum->g += weight * color.g;
    sum->b += weight * color.b;
    sum->weight += weight;
}

/* The weights must not add up to 0. */
static inline rgb color_sum_mean(const struct color_sum *sum)
{
    double k = 1.0 / sum->weight;
    return rgb_make((float)(sum->r * k), (float)(sum->g * k),
                    (float)(sum->b * k));
}

#endif
