/* specular_differential.c - see specular_differential.h. */
#include "materials/specular_differential.h"

//> specular_differential.turn: One bounce, and its normal
/* One bounce: the directions before and after it run with the ray, the normal
 * faces the first of them. ratio: the index here over the index beyond. */
struct turn {
    vec3 before, after, normal;
    float ratio;
    bool transmitted;
};

/* The shading or the geometric normal (specular.h), whichever outgoing was
 * turned about: it lies along the sum of the two directions, each times the
 * index on its side. That is Snell's law in one line. */
static vec3 normal_in_use(const struct surface *s, vec3 outgoing,
                          const struct scatter *way, float ratio)
{
    float weight = way->transmitted ? ratio : 1.0f;
    vec3 along = vec3_step(way->incoming, weight, outgoing);
    float smooth = fabsf(vec3_dot(along, s->shading_normal));
    float geometric = fabsf(vec3_dot(along, s->geometric_normal));
    return smooth >= geometric ? s->shading_normal : s->geometric_normal;
}

static struct turn turn_make(const struct material *m, const struct surface *s,
                             const ray *r, const struct scatter *way)
{
    struct turn t = {.before = r->direction,
                     .after = way->incoming,
                     .transmitted = way->transmitted};
    vec3 outgoing = vec3_negate(r->direction);
    bool outside = vec3_dot(outgoing, s->geometric_normal) >= 0.0f;
    t.ratio = outside ? 1.0f / m->eta : m->eta;
    t.normal = normal_in_use(s, outgoing, way, t.ratio);
    if (!outside)
        t.normal = vec3_negate(t.normal);
    return t;
}
//< specular_differential.turn

//> specular_differential.mirror: What a mirror does to a width
/* after = before - 2 (before . normal) normal */
static vec3 reflected_change(const struct turn *t, vec3 before_change,
                             vec3 normal_change)
{
    float cosine = vec3_dot(t->before, t->normal);
    float cosine_change =
        vec3_dot(before_change, t->normal) + vec3_dot(t->before, normal_change);
    vec3 step = vec3_step(before_change, -2.0f * cosine, normal_change);
    return vec3_step(step, -2.0f * cosine_change, t->normal);
}
//< specular_differential.mirror

//> specular_differential.lens: What a boundary does to a width
/* after = ratio before - mu normal; mu = ratio (before . normal) -
 * (after . normal), where the last is a cosine that Snell's law ties to the
 * first: Igehy's equations 15 to 18. */
static vec3 refracted_change(const struct turn *t, vec3 before_change,
                             vec3 normal_change)
{
    float cosine = vec3_dot(t->before, t->normal);
    float cosine_beyond = vec3_dot(t->after, t->normal);
    float cosine_change =
        vec3_dot(before_change, t->normal) + vec3_dot(t->before, normal_change);
    float mu = t->ratio * cosine - cosine_beyond;
    float mu_change =
        t->ratio * (1.0f - t->ratio * cosine / cosine_beyond) * cosine_change;
    vec3 step =
        vec3_step(vec3_scale(before_change, t->ratio), -mu, normal_change);
    return vec3_step(step, -mu_change, t->normal);
}
//< specular_differential.lens

/* dn_du and dn_dv are the shading normal's. At the rim of a mesh the geometric
 * one may stand in for it; its turning is not known, and this one serves. */
static vec3 direction_change(const struct surface *s, const struct turn *t,
                             vec3 before_change, vec2 uv_step)
{
    bool turned = vec3_dot(t->normal, s->shading_normal) < 0.0f;
    vec3 normal_change =
        vec3_step(vec3_scale(s->dn_du, uv_step.x), uv_step.y, s->dn_dv);
    if (turned)
        normal_change = vec3_negate(normal_change);
    return t->transmitted ? refracted_change(t, before_change, normal_change)
                          : reflected_change(t, before_change, normal_change);
}

static vec3 or_zero(vec3 v)
{
    return vec3_is_finite(v) ? v : vec3_make(0.0f, 0.0f, 0.0f);
}

void material_specular_differential(const struct material *m,
                                    const struct surface *s, const ray *r,
                                    const struct ray_differential *in,
                                    const struct scatter *way,
                                    struct ray_differential *out)
{
    struct turn t = turn_make(m, s, r, way);
    struct ray_differential d;
    struct surface at = *s;
    surface_footprint(&at, r, in);
    surface_step(s, r, in, &d.origin_dx, &d.origin_dy);
    d.direction_dx =
        or_zero(direction_change(s, &t, in->direction_dx, at.uv_dx));
    d.direction_dy =
        or_zero(direction_change(s, &t, in->direction_dy, at.uv_dy));
    *out = d;
}
