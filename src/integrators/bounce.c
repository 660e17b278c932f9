/* bounce.c - see bounce.h. */
#include "integrators/bounce.h"

#include "materials/specular_differential.h"

/* A rough bounce spreads light so widely that the pixel's own width no longer
 * matters: the footprint is dropped, and textures seen by it are not
 * filtered. */
static void continue_differential(const struct vertex *v, const ray *r,
                                  const struct scatter *way,
                                  struct ray_differential *d)
{
    static const struct ray_differential none;
    struct ray_differential next = none;
    if (way->specular && !ray_differential_is_zero(d))
        material_specular_differential(v->object->material, &v->surface, r, d,
                                       way, &next);
    *d = next;
}

bool bounce(const struct tracer *t, const struct vertex *v, ray *r,
            struct ray_differential *d, struct scatter *way)
{
    vec2 pair = sampler_2d(t->sampler);
    const float random[3] = {pair.x, pair.y, sampler_1d(t->sampler)};
    if (!material_sample(v->object->material, &v->surface, v->outgoing, random,
                         way))
        return false;
    path_log_scatter(t->log, way);
    if (way->specular)
        counters_mine.specular_rays++;
    else
        counters_mine.bounce_rays++;
    continue_differential(v, r, way, d);
    *r = surface_ray(&v->surface, way->incoming, INFINITY);
    return true;
}
