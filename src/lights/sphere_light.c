/* sphere_light.c - see sphere_light.h. */
#include "lights/sphere_light.h"

#include "base/constants.h"
#include "base/minmax.h"
#include "sampling/warp.h"

/* The cone of directions in which a point sees the sphere. */
struct cone {
    vec3 axis;  /* to the centre, unit */
    float sine; /* of the angle from the axis to the rim: radius over
                         distance */
    float one_minus_cosine; /* of the same angle */
};

/* In double, so that neither a sphere far away (the cosine is 1 in float) nor
 * one that nearly touches (distance and radius cancel) loses its digits. */
static bool visible_cone(const struct sphere *s, vec3 point, struct cone *out)
{
    vec3 way = vec3_sub(s->center, point);
    double distance2 =
        (double)way.x * way.x + (double)way.y * way.y + (double)way.z * way.z;
    double sine2 = (double)s->radius * s->radius / distance2;
    if (!(sine2 <= 1.0))
        return false;
    out->axis = vec3_scale(way, (float)(1.0 / sqrt(distance2)));
    out->sine = (float)sqrt(sine2);
    out->one_minus_cosine = (float)(sine2 / (1.0 + sqrt(1.0 - sine2)));
    return true;
}

static vec3 from_frame(vec3 axis, vec3 local)
{
    vec3 s, t;
    vec3_frame(axis, &s, &t);
    vec3 side = vec3_add(vec3_scale(s, local.x), vec3_scale(t, local.y));
    return vec3_step(side, local.z, axis);
}

/* The normal where a direction (in the cone's frame) first meets the sphere.
 * With x = sin theta / sine, the share of the way from the axis to the rim,
 * the hit is distance cos theta - radius sqrt(1 - x^2) away, and the angle at
 * the centre has the cosine x^2 sine + cos theta sqrt(1 - x^2). */
static vec3 cap_normal(const struct cone *cone, vec3 local)
{
    float x = sqrtf(local.x * local.x + local.y * local.y) / cone->sine;
    float root = sqrtf(float_max(0.0f, 1.0f - x * x));
    float radii_away = local.z / cone->sine - root;
    float cosine = x * x * cone->sine + local.z * root;
    return vec3_make(local.x * radii_away, local.y * radii_away, -cosine);
}

bool sphere_light_sample(const struct sphere *s, vec3 point, vec2 random,
                         vec3 *direction, vec3 *place, vec3 *normal)
{
    struct cone cone;
    if (!visible_cone(s, point, &cone))
        return false;
    vec3 local = warp_cone(random, cone.one_minus_cosine);
    *direction = from_frame(cone.axis, local);
    *normal = from_frame(cone.axis, cap_normal(&cone, local));
    *place = vec3_step(s->center, s->radius, *normal);
    return true;
}

float sphere_light_pdf(const struct sphere *s, vec3 point)
{
    struct cone cone;
    if (!visible_cone(s, point, &cone))
        return 0.0f;
    return 1.0f / (2.0f * PI * cone.one_minus_cosine);
}
