/* mis.h - multiple importance sampling: two ways to find the same light share
 * it, each where it is good.
 *
 * E. Veach, "Robust Monte Carlo Methods for Light Transport Simulation", 1997,
 * section 9.2.4. */
#ifndef RAYBOOK_INTEGRATORS_MIS_H
#define RAYBOOK_INTEGRATORS_MIS_H

/* The share of the way that found a direction with density pdf (above 0),
 * beside another that would have found it with density `other`:
 * pdf^2 / (pdf^2 + other^2). By the ratio, since the squares of a sun's density
 * may overflow. */
static inline float power_heuristic(float pdf, float other)
{
    float ratio = other / pdf;
    return 1.0f / (1.0f + ratio * ratio);
}

#endif
