/* filter.h - how far from a pixel's centre its samples are taken.
 *
 * A pixel is the average of the picture, weighted by the filter around the
 * pixel's centre. Samples are drawn from the filter itself, so that each
 * counts the same and no pixel needs another's samples: M. Ernst et al.,
 * "Filter Importance Sampling", IEEE Symposium on Interactive Ray Tracing,
 * 2006. */
#ifndef RAYBOOK_CAMERA_FILTER_H
#define RAYBOOK_CAMERA_FILTER_H

#include "base/vec.h"

/* The box filter: random numbers in [0, 1)^2 to an offset from the pixel's
 * centre, uniform in the square of side 2 radius, in pixels. */
static inline vec2 filter_box_sample(float radius, vec2 random)
{
    return vec2_make(radius * (2.0f * random.x - 1.0f),
                     radius * (2.0f * random.y - 1.0f));
}

#endif
