/* vec.h - points, directions and texture coordinates in single precision.
 *
 * One type serves for points and directions; names say which is meant
 * (origin, position / direction, normal). Everything is by value and
 * inline: the compiler keeps these in registers. */
#ifndef RAYBOOK_BASE_VEC_H
#define RAYBOOK_BASE_VEC_H

#include <math.h>
#include <stdbool.h>

#include "base/minmax.h"

typedef struct {
    float x, y;
} vec2;

typedef struct {
    float x, y, z;
} vec3;

static inline vec2 vec2_make(float x, float y)
{
    vec2 v = {x, y};
    return v;
}

static inline vec3 vec3_make(float x, float y, float z)
{
    vec3 v = {x, y, z};
    return v;
}

static inline vec3 vec3_add(vec3 a, vec3 b)
{
    return vec3_make(a.x + b.x, a.y + b.y, a.z + b.z);
}

static inline vec3 vec3_sub(vec3 a, vec3 b)
{
    return vec3_make(a.x - b.x, a.y - b.y, a.z - b.z);
}

static inline vec3 vec3_scale(vec3 a, float k)
{
    return vec3_make(a.x * k, a.y * k, a.z * k);
}

/* a + k b: a step of length k along b. */
static inline vec3 vec3_step(vec3 a, float k, vec3 b)
{
    return vec3_make(a.x + k * b.x, a.y + k * b.y, a.z + k * b.z);
}

static inline vec3 vec3_negate(vec3 a)
{
    return vec3_make(-a.x, -a.y, -a.z);
}

static inline float vec3_dot(vec3 a, vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline vec3 vec3_cross(vec3 a, vec3 b)
{
    return vec3_make(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z,
                     a.x * b.y - a.y * b.x);
}

static inline float vec3_length(vec3 a)
{
    return sqrtf(vec3_dot(a, a));
}

/* a / |a|. The length must be positive: the caller rules out zero vectors. */
static inline vec3 vec3_normalize(vec3 a)
{
    return vec3_scale(a, 1.0f / vec3_length(a));
}

static inline vec3 vec3_min(vec3 a, vec3 b)
{
    return vec3_make(float_min(a.x, b.x), float_min(a.y, b.y),
                     float_min(a.z, b.z));
}

static inline vec3 vec3_max(vec3 a, vec3 b)
{
    return vec3_make(float_max(a.x, b.x), float_max(a.y, b.y),
                     float_max(a.z, b.z));
}

static inline vec3 vec3_abs(vec3 a)
{
    return vec3_make(fabsf(a.x), fabsf(a.y), fabsf(a.z));
}

/* The component along axis 0, 1 or 2. */
static inline float vec3_axis(vec3 a, int axis)
{
    return axis == 0 ? a.x : axis == 1 ? a.y : a.z;
}

static inline bool vec3_is_finite(vec3 a)
{
    return isfinite(a.x) && isfinite(a.y) && isfinite(a.z);
}

/* Two unit vectors that form a right-handed orthonormal frame (s, t, n) with
 * the unit vector n. Continuous but for n.z = -0 and exact for every unit
 * n: Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1),
 * 2017. */
static inline void vec3_frame(vec3 n, vec3 *s, vec3 *t)
{
    float sign = copysignf(1.0f, n.z);
    float a = -1.0f / (sign + n.z);
    float b = n.x * n.y * a;
    *s = vec3_make(1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x);
    *t = vec3_make(b, sign + n.y * n.y * a, -n.y);
}

#endif
