/* filter.h - how a pixel weighs the picture around its centre.
 *
 * A pixel is the average of the picture, weighted by the filter around the
 * pixel's centre. Samples are drawn from the filter itself, so that no pixel
 * needs another's samples and the film's border is no special case: M. Ernst,
 * M. Stamminger, G. Greiner, "Filter Importance Sampling", IEEE Symposium on
 * Interactive Ray Tracing, 2006. */
#ifndef RAYBOOK_CAMERA_FILTER_H
#define RAYBOOK_CAMERA_FILTER_H

#include "base/vec.h"
#include "scene/settings.h"

enum { FILTER_CELLS = 512 };

/* One axis of the filter, tabulated: all kinds are products of a function of
 * x and the same function of y. */
struct filter {
    enum filter_kind kind;
    float radius;
    float alpha, b, c;           /* gaussian; mitchell */
    float cdf[FILTER_CELLS + 1]; /* of |f|, over [-radius, radius] */
    float mass;                  /* integral of |f| over integral of f */
    float integral;              /* of f, over [-radius, radius] */
};

struct filter filter_make(const struct film_settings *film);

/* The one-dimensional filter at x, in pixels from the centre; 0 outside
 * [-radius, radius].
 * box: 1. tent: 1 - |x| / radius. gaussian: exp(-alpha x^2) - exp(-alpha
 * radius^2). mitchell: the cubic of D. Mitchell and A. Netravali,
 * "Reconstruction Filters in Computer Graphics", SIGGRAPH 1988, equation 8,
 * stretched so that its support of 2 becomes the radius. */
float filter_value(const struct filter *f, float x);

/* An offset from the pixel's centre, drawn with density |f| / integral |f|, and
 * its weight: the sign of f times mass^2. The weights average to one. */
vec2 filter_sample(const struct filter *f, vec2 random, float *weight);

#endif
