/* lanes.h - arithmetic for loops over eight lanes. */
#ifndef RAYBOOK_ACCEL_LANES_H
#define RAYBOOK_ACCEL_LANES_H

#include <math.h>

/* Not fminf and fmaxf, whose care for NaN costs several instructions: these
 * are one. Where one of the two is NaN, the answer is b. */
static inline float lesser(float a, float b)
{
    return a < b ? a : b;
}

static inline float greater(float a, float b)
{
    return a > b ? a : b;
}

/* a b + c, in one rounding where the processor has an instruction for it. For
 * filters only: the result depends on the machine. */
static inline float multiply_add(float a, float b, float c)
{
#if defined(FP_FAST_FMAF) || defined(__FMA__)
    return fmaf(a, b, c);
#else
    return a * b + c;
#endif
}

#endif
