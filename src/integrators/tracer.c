/* tracer.c - see tracer.h. */
#include "integrators/tracer.h"

bool tracer_hit(const struct tracer *t, const ray *r,
                const struct ray_differential *d, struct vertex *out)
{
    struct scene_hit hit;
    if (!scene_nearest(t->scene, r, &hit)) {
        path_log_miss(t->log);
        return false;
    }
    scene_surface(t->scene, r, &hit, &out->object, &out->surface);
    surface_footprint(&out->surface, r, d);
    out->outgoing = vec3_negate(vec3_normalize(r->direction));
    out->t = hit.t;
    path_log_hit(t->log, t->scene, out->object, &out->surface, hit.t);
    return true;
}

rgb vertex_emitted(const struct tracer *t, const struct vertex *v)
{
    if (v->object->light < 0)
        return rgb_grey(0.0f);
    return light_emitted(&t->scene->lights[v->object->light],
                         v->surface.geometric_normal, v->outgoing);
}
