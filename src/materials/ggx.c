/* ggx.c - see ggx.h. */
#include "materials/ggx.h"

#include "base/constants.h"
#include "base/minmax.h"
#include "sampling/warp.h"

//> ggx.density: How many mirrors lie like this
float ggx_density(vec2 alpha, vec3 normal)
{
    float x = normal.x / alpha.x, y = normal.y / alpha.y;
    float length2 = x * x + y * y + normal.z * normal.z;
    return 1.0f / (PI * alpha.x * alpha.y * length2 * length2);
}
//< ggx.density

//> ggx.seen: How many of them are seen
/* Rough mirrors become a hemisphere when the surface is stretched. */
static vec3 stretch(vec2 alpha, vec3 v)
{
    return vec3_make(alpha.x * v.x, alpha.y * v.y, v.z);
}

float ggx_seen_over_cosine(vec2 alpha, vec3 direction)
{
    return 2.0f / (direction.z + vec3_length(stretch(alpha, direction)));
}
//< ggx.seen

//> ggx.sample: Pick a mirror that is seen
/* A unit vector at right angles to v that is level: z = 0. */
static vec3 level(vec3 v)
{
    float length = sqrtf(v.x * v.x + v.y * v.y);
    if (!(length > 0.0f))
        return vec3_make(1.0f, 0.0f, 0.0f);
    return vec3_make(-v.y / length, v.x / length, 0.0f);
}

/* A point of the hemisphere as it is seen from afar along `view`: a disk whose
 * lower half is covered in part, by the plane on which the hemisphere lies.
 * The disk's lower half is squeezed into what is left of it. */
static vec3 sample_hemisphere_seen(vec3 view, vec2 random)
{
    vec3 x = level(view), y = vec3_cross(view, x);
    vec2 p = warp_disk(random);
    float half = sqrtf(float_max(0.0f, 1.0f - p.x * p.x));
    float squeeze = 0.5f * (1.0f + view.z);
    p.y = (1.0f - squeeze) * half + squeeze * p.y;
    float height = sqrtf(float_max(0.0f, 1.0f - p.x * p.x - p.y * p.y));
    return vec3_step(vec3_step(vec3_scale(x, p.x), p.y, y), height, view);
}

vec3 ggx_sample_seen(vec2 alpha, vec3 direction, vec2 random)
{
    vec3 view = vec3_normalize(stretch(alpha, direction));
    vec3 n = sample_hemisphere_seen(view, random);
    n.z = float_max(0.0f, n.z);
    return vec3_normalize(stretch(alpha, n));
}
//< ggx.sample
