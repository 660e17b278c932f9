/* sphere.c - see sphere.h. */
#include "shapes/sphere.h"

#include "base/constants.h"
#include "base/minmax.h"

bool sphere_intersect(const struct sphere *s, const ray *r, float *t)
{
    /* The ray's nearest approach to the centre first: its distance to the
     * centre has no large terms that cancel, unlike b^2 - 4ac. */
    vec3 to_center = vec3_sub(s->center, r->origin);
    float a = vec3_dot(r->direction, r->direction);
    float b = vec3_dot(to_center, r->direction);
    vec3 miss = vec3_sub(to_center, vec3_scale(r->direction, b / a));
    float radius2 = s->radius * s->radius;
    float inside = radius2 - vec3_dot(miss, miss);
    if (!(inside >= 0.0f))
        return false;
    float q = b + copysignf(sqrtf(a * inside), b);
    float c = vec3_dot(to_center, to_center) - radius2;
    float t0 = c / q, t1 = q / a;
    float near = t0 < t1 ? t0 : t1, far = t0 < t1 ? t1 : t0;
    float root = near >= r->t_min ? near : far;
    if (!(root >= r->t_min && root <= r->t_max))
        return false;
    *t = root;
    return true;
}

/* phi in [0, 2 pi) */
static float azimuth(vec3 d)
{
    float phi = atan2f(d.y, d.x);
    return phi < 0.0f ? phi + 2.0f * PI : phi;
}

/* dp_du is the zero vector at the poles, where phi has no meaning. */
static void sphere_differentials(const struct sphere *s, vec3 n,
                                 struct surface *out)
{
    vec3 radial = vec3_scale(n, s->radius);
    float sin_theta = sqrtf(n.x * n.x + n.y * n.y);
    float cos_phi = sin_theta > 0.0f ? n.x / sin_theta : 1.0f;
    float sin_phi = sin_theta > 0.0f ? n.y / sin_theta : 0.0f;
    out->dp_du = vec3_make(-2.0f * PI * radial.y, 2.0f * PI * radial.x, 0.0f);
    out->dp_dv = vec3_scale(vec3_make(n.z * cos_phi, n.z * sin_phi, -sin_theta),
                            PI * s->radius);
    out->dn_du = vec3_scale(out->dp_du, 1.0f / s->radius);
    out->dn_dv = vec3_scale(out->dp_dv, 1.0f / s->radius);
}

void sphere_surface(const struct sphere *s, const ray *r, float t,
                    struct surface *out)
{
    static const struct surface nothing;
    vec3 n = vec3_normalize(vec3_sub(ray_at(r, t), s->center));
    float theta = acosf(float_max(-1.0f, float_min(1.0f, n.z)));
    *out = nothing;
    out->position = vec3_step(s->center, s->radius, n);
    /* n is exact to 4 roundings, its product and the sum add one each. */
    vec3 size = vec3_add(vec3_abs(s->center),
                         vec3_make(s->radius, s->radius, s->radius));
    out->position_error = vec3_scale(size, rounding_bound(6));
    out->geometric_normal = n;
    out->shading_normal = n;
    out->uv = vec2_make(azimuth(n) / (2.0f * PI), theta / PI);
    sphere_differentials(s, n, out);
}

aabb sphere_bounds(const struct sphere *s)
{
    vec3 half = vec3_make(s->radius, s->radius, s->radius);
    aabb box = {vec3_sub(s->center, half), vec3_add(s->center, half)};
    return box;
}
