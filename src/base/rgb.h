/* rgb.h - linear colour: radiance, albedo, flux.
 *
 * Three components with Rec. 709 primaries and a D65 white, linear in the
 * physical quantity, so that adding lights is adding colours. */
#ifndef RAYBOOK_BASE_RGB_H
#define RAYBOOK_BASE_RGB_H

#include <math.h>
#include <stdbool.h>

typedef struct {
    float r, g, b;
} rgb;

static inline rgb rgb_make(float r, float g, float b)
{
    rgb c = {r, g, b};
    return c;
}

static inline rgb rgb_grey(float value)
{
    return rgb_make(value, value, value);
}

static inline rgb rgb_add(rgb a, rgb b)
{
    return rgb_make(a.r + b.r, a.g + b.g, a.b + b.b);
}

static inline rgb rgb_mul(rgb a, rgb b)
{
    return rgb_make(a.r * b.r, a.g * b.g, a.b * b.b);
}

static inline rgb rgb_scale(rgb a, float k)
{
    return rgb_make(a.r * k, a.g * k, a.b * k);
}

/* a for t = 0, b for t = 1; exactly a where the two are equal. */
static inline rgb rgb_mix(rgb a, rgb b, float t)
{
    return rgb_make(a.r + t * (b.r - a.r), a.g + t * (b.g - a.g),
                    a.b + t * (b.b - a.b));
}

static inline bool rgb_is_black(rgb a)
{
    return a.r == 0.0f && a.g == 0.0f && a.b == 0.0f;
}

/* Rec. 709 luminance (ITU-R BT.709-6, section 3.2), in the colour's unit. */
static inline float rgb_luminance(rgb a)
{
    return 0.2126f * a.r + 0.7152f * a.g + 0.0722f * a.b;
}

#endif
