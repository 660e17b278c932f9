/* minmax.h - the smaller and the larger of two floats.
 *
 * What fminf and fmaxf answer, but for the sign of a zero. Those are calls into
 * the library, around which a compiler has to save what it holds in registers;
 * these are two instructions or three. */
#ifndef RAYBOOK_BASE_MINMAX_H
#define RAYBOOK_BASE_MINMAX_H

#include <math.h>

/* If one is NaN, the other one. */
static inline float float_min(float a, float b)
{
    float smaller = b < a ? b : a;
    return isnan(a) ? b : smaller;
}

static inline float float_max(float a, float b)
{
    float larger = b > a ? b : a;
    return isnan(a) ? b : larger;
}

#endif
