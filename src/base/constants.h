/* constants.h - numbers that the whole program shares. */
#ifndef RAYBOOK_BASE_CONSTANTS_H
#define RAYBOOK_BASE_CONSTANTS_H

#define PI 3.14159265358979323846f

/* Bound on the relative error of n floating point operations in a row,
 * n u / (1 - n u) with u = 2^-24: N. Higham, "Accuracy and Stability of
 * Numerical Algorithms", section 3.1, where it is called gamma_n. */
static inline float rounding_bound(int n)
{
    return (float)n * 0x1p-24f / (1.0f - (float)n * 0x1p-24f);
}

#endif
