/* warp.c - see warp.h. */
#include "sampling/warp.h"

#include "base/constants.h"
#include "base/minmax.h"

//> warp.disk: Bend the square into a disk
/* A point of the unit disk at a radius and an angle. */
static vec2 polar(float radius, float angle)
{
    return vec2_make(radius * cosf(angle), radius * sinf(angle));
}

vec2 warp_disk(vec2 random)
{
    float x = 2.0f * random.x - 1.0f, y = 2.0f * random.y - 1.0f;
    if (x == 0.0f && y == 0.0f)
        return vec2_make(0.0f, 0.0f);
    if (fabsf(x) > fabsf(y))
        return polar(x, PI / 4.0f * (y / x));
    return polar(y, PI / 2.0f - PI / 4.0f * (x / y));
}

float warp_disk_pdf(vec2 point)
{
    return point.x * point.x + point.y * point.y <= 1.0f ? 1.0f / PI : 0.0f;
}
//< warp.disk

//> warp.sphere: Spread directions over the sphere
/* The direction that is `height` (in [0, 2]) below the pole, measured along
 * the axis: by Archimedes' theorem even heights are even areas. */
static vec3 below_pole(float height, float turn)
{
    vec2 side = polar(sqrtf(height * (2.0f - height)), 2.0f * PI * turn);
    return vec3_make(side.x, side.y, 1.0f - height);
}

vec3 warp_sphere(vec2 random)
{
    return warp_cone(random, 2.0f);
}

float warp_sphere_pdf(vec3 direction)
{
    return warp_cone_pdf(direction, 2.0f);
}

vec3 warp_hemisphere(vec2 random)
{
    return warp_cone(random, 1.0f);
}

float warp_hemisphere_pdf(vec3 direction)
{
    return warp_cone_pdf(direction, 1.0f);
}
//< warp.sphere

//> warp.cosine: Lift the disk onto the hemisphere
vec3 warp_cosine_hemisphere(vec2 random)
{
    vec2 d = warp_disk(random);
    float z = sqrtf(float_max(0.0f, 1.0f - d.x * d.x - d.y * d.y));
    return vec3_make(d.x, d.y, z);
}

float warp_cosine_hemisphere_pdf(vec3 direction)
{
    return float_max(0.0f, direction.z) / PI;
}
//< warp.cosine

//> warp.cone: Keep to a cone
vec3 warp_cone(vec2 random, float one_minus_cosine)
{
    return below_pole(random.x * one_minus_cosine, random.y);
}

/* 1 - z of a unit vector: near the pole x and y still have the digits that z
 * has lost. */
static float one_minus_z(vec3 d)
{
    float side = d.x * d.x + d.y * d.y;
    return d.z > 0.0f ? side / (1.0f + d.z) : 1.0f - d.z;
}

float warp_cone_pdf(vec3 direction, float one_minus_cosine)
{
    bool inside = one_minus_z(direction) <= one_minus_cosine;
    return inside ? 1.0f / (2.0f * PI * one_minus_cosine) : 0.0f;
}
//< warp.cone

//> warp.triangle: Fold the square into a triangle
vec2 warp_triangle(vec2 random)
{
    float x = random.x, y = random.y;
    float half_smaller = 0.5f * (x < y ? x : y);
    return vec2_make(x - half_smaller, y - half_smaller);
}

float warp_triangle_pdf(vec2 weights)
{
    bool inside =
        weights.x >= 0.0f && weights.y >= 0.0f && weights.x + weights.y <= 1.0f;
    return inside ? 2.0f : 0.0f;
}
//< warp.triangle

//> warp.bilinear: Follow a bilinear blend
/* Over [0, 1], in proportion to a line from a at 0 to b at 1, not both 0: the
 * inverse of the integral, in the form that does not cancel where a = b. */
static float linear(float random, float a, float b)
{
    float root = sqrtf((1.0f - random) * a * a + random * b * b);
    return float_min(random * (a + b) / (a + root), ONE_MINUS_EPSILON);
}

vec2 warp_bilinear(vec2 random, const float corners[4])
{
    const float *c = corners;
    float top = c[0] + c[1], bottom = c[2] + c[3];
    if (!(top + bottom > 0.0f))
        return random;
    float y = linear(random.y, top, bottom);
    float left = c[0] + y * (c[2] - c[0]), right = c[1] + y * (c[3] - c[1]);
    return vec2_make(linear(random.x, left, right), y);
}

float warp_bilinear_pdf(vec2 point, const float corners[4])
{
    const float *c = corners;
    float sum = c[0] + c[1] + c[2] + c[3];
    if (!(sum > 0.0f))
        return 1.0f;
    float left = c[0] + point.y * (c[2] - c[0]);
    float right = c[1] + point.y * (c[3] - c[1]);
    return 4.0f * (left + point.x * (right - left)) / sum;
}
//< warp.bilinear
