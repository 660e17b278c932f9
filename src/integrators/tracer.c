/* tracer.c - see tracer.h. */
#include "integrators/tracer.h"

/* The object is in *out already. */
static void describe(const struct tracer *t, const ray *r,
                     const struct ray_differential *d,
                     const struct scene_hit *hit, struct vertex *out)
{
    scene_surface(t->scene, r, hit, out->object, &out->surface);
    surface_footprint(&out->surface, r, d);
    out->outgoing = vec3_negate(vec3_normalize(r->direction));
    out->t = hit->t;
    path_log_hit(t->log, t->scene, out->object, &out->surface, hit->t);
}

static bool find(const struct tracer *t, const ray *r, struct scene_hit *hit,
                 struct vertex *out)
{
    if (!scene_nearest(t->scene, r, hit)) {
        path_log_miss(t->log);
        return false;
    }
    out->object = scene_object(t->scene, hit);
    return true;
}

bool tracer_hit(const struct tracer *t, const ray *r,
                const struct ray_differential *d, struct vertex *out)
{
    struct scene_hit hit;
    if (!find(t, r, &hit, out))
        return false;
    describe(t, r, d, &hit, out);
    return true;
}

bool tracer_light(const struct tracer *t, const ray *r,
                  const struct ray_differential *d, struct vertex *out)
{
    struct scene_hit hit;
    if (!find(t, r, &hit, out))
        return false;
    if (out->object->light >= 0 || t->log != NULL)
        describe(t, r, d, &hit, out);
    return true;
}

rgb vertex_emitted(const struct tracer *t, const struct vertex *v)
{
    if (v->object->light < 0)
        return rgb_grey(0.0f);
    return light_emitted(&t->scene->lights[v->object->light],
                         v->surface.geometric_normal, v->outgoing);
}
