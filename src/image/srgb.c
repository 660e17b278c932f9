/* srgb.c - see srgb.h. */
#include "image/srgb.h"

#include <math.h>

float srgb_decode(float code)
{
    double c = code;
    return (float)(c <= 0.04045 ? c / 12.92 : pow((c + 0.055) / 1.055, 2.4));
}
